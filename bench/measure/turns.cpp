#include "bench/measure/turns.h"

#include "bench/measure/work.h"
#include "bench/report/table.h"

namespace dspm {
namespace {

/// The time of all `frames` one by one, from the mean of those that were measured.
Rounds for_all(Rounds means, std::size_t frames) {
  for (StepSeconds& round : means)
    for (double& seconds : round) seconds *= static_cast<double>(frames);
  return means;
}

/// The total's speedup if each step reached its factor.
double factor_of_all(const StepSeconds& separate, const StepSeconds& factors) {
  double together = 0;
  for (std::size_t s = 0; s + 1 < kStepNames.size(); ++s) together += separate[s] / factors[s];
  return separate.back() / together;
}

InTurns compare(const std::vector<Rounds>& seconds, const Integrator& together, const Group& separate,
                std::size_t frames) {
  const Rounds of_all = for_all(seconds[1], frames);
  InTurns c;
  c.frames = static_cast<int>(frames);
  c.together = medians(seconds[0]), c.separate = medians(of_all);
  c.speedups = ratios(of_all, seconds[0]);
  c.factors = sharing_factors(mean_work(separate), static_cast<double>(frames), work_of(together));
  c.factors.back() = factor_of_all(c.separate, c.factors);
  const Statistics s = together.statistics();
  c.dynamic_photons = s.photon.dynamic_share(), c.dynamic_hit_points = s.camera.dynamic_share();
  return c;
}

}  // namespace

// Left to itself, dsppm leaves more to camera paths the more frames share them: times of an iteration would then be those of
// different work.
InTurns take_turns(const LoadedScene& loaded, const Job& asked, const TurnSettings& settings) {
  const Job job = with_text(asked, "indirect", "photons");
  std::vector<Group> groups(2);
  groups[0].push_back(start(loaded, job, "dsppm", job.frames));
  groups[1] = start_each(loaded, job, "sppm", spread_frames(job.frames, settings.separate));
  const std::vector<Rounds> seconds = in_turns(groups, settings.iterations);
  return compare(seconds, *groups[0][0].integrator, groups[1], job.frames.size());
}

std::string table_of(const InTurns& c, const wg12::Speedups* paper) {
  std::vector<std::string> head = {"step",    "dsppm, s",       fmt::format("{} x sppm, s", c.frames),
                                   "speedup", "sharing factor", "reached"};
  if (paper != nullptr) head.push_back("WG12");
  Table table(head);
  for (std::size_t s = 0; s < kStepNames.size(); ++s) {
    std::vector<std::string> cells = {kStepNames[s],
                                      seconds_cell(c.together[s]),
                                      seconds_cell(c.separate[s]),
                                      ratio_cell(c.speedups[s]),
                                      ratio_cell(c.factors[s]),
                                      fmt::format("{:.0f}%", 100 * c.speedups[s] / c.factors[s])};
    if (paper != nullptr) cells.push_back(ratio_cell((*paper)[s]));
    table.row(cells);
  }
  return table.text();
}

std::string dynamic_shares(const InTurns& c) {
  return fmt::format("{} of the photon paths and {} of the camera paths met something that differs between frames.",
                     percent_cell(c.dynamic_photons), percent_cell(c.dynamic_hit_points));
}

}  // namespace dspm
