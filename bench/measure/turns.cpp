#include "bench/measure/turns.h"

#include "bench/report/progress.h"
#include "bench/report/table.h"

namespace dspm {
namespace {

StepSeconds ratios(const std::vector<StepSeconds>& separate, const std::vector<StepSeconds>& together) {
  std::vector<StepSeconds> rounds = separate;
  for (std::size_t i = 0; i < rounds.size(); ++i)
    for (std::size_t s = 0; s < kSteps.size(); ++s) rounds[i][s] /= together[i][s];
  return medians(rounds);
}

/// What all `frames` take one by one, from those that were measured.
StepSeconds scaled_sum(const std::vector<StepSeconds>& measured, std::size_t frames) {
  StepSeconds sum{};
  for (std::size_t s = 0; s < sum.size(); ++s) {
    for (const StepSeconds& seconds : measured) sum[s] += seconds[s];
    sum[s] *= static_cast<double>(frames) / static_cast<double>(measured.size());
  }
  return sum;
}

/// The total's speedup if each step reached its factor.
double factor_of_all(const StepSeconds& separate, const StepSeconds& factors) {
  double together = 0;
  for (std::size_t s = 0; s + 1 < kSteps.size(); ++s) together += separate[s] / factors[s];
  return separate.back() / together;
}

/// By iteration.
struct Rounds {
  std::vector<StepSeconds> together, separate;
};

Comparison compare(const Rounds& rounds, const Statistics& s, std::size_t frames) {
  Comparison c;
  c.frames = static_cast<int>(frames);
  c.together = medians(rounds.together), c.separate = medians(rounds.separate);
  c.speedups = ratios(rounds.separate, rounds.together);
  c.factors = {s.camera.segments.factor(), s.photon.segments.factor(), s.photons_stored.factor(),
               s.photon_tests.factor(), 0};
  c.factors.back() = factor_of_all(c.separate, c.factors);
  c.dynamic_photons = s.photon.dynamic_share(), c.dynamic_hit_points = s.camera.dynamic_share();
  return c;
}

}  // namespace

StepSeconds timed_iteration(Integrator& integrator, int iteration) {
  const Statistics before = integrator.statistics();
  integrator.iterate(iteration);
  const Statistics after = integrator.statistics();
  StepSeconds seconds{};
  for (std::size_t i = 0; i < after.steps.size(); ++i) {
    const double taken = after.steps[i].seconds - before.steps[i].seconds;
    for (std::size_t s = 0; s + 1 < kSteps.size(); ++s)
      if (after.steps[i].name == kSteps[s]) seconds[s] += taken;
    seconds.back() += taken;
  }
  return seconds;
}

StepSeconds medians(const std::vector<StepSeconds>& rounds) {
  StepSeconds result{};
  for (std::size_t s = 0; s < kSteps.size(); ++s) {
    std::vector<double> values;
    for (const StepSeconds& round : rounds) values.push_back(round[s]);
    result[s] = median(values);
  }
  return result;
}

Comparison take_turns(const LoadedScene& loaded, const Job& job, const TurnSettings& settings) {
  const Run together = start(loaded, job, "dsppm", job.frames);
  std::vector<Run> alone;
  for (const Frame f : spread_frames(job.frames, settings.separate)) alone.push_back(start(loaded, job, "sppm", {f}));

  Rounds rounds;
  for (int i = 0; i < settings.iterations; ++i) {
    const StepSeconds joint = timed_iteration(*together.integrator, i);
    std::vector<StepSeconds> separate;
    for (const Run& run : alone) separate.push_back(timed_iteration(*run.integrator, i));
    const StepSeconds sum = scaled_sum(separate, job.frames.size());
    say("iteration {} of {}: {:.2f} s together, {:.2f} s separately", i + 1, settings.iterations, joint.back(),
        sum.back());
    if (i == 0 && settings.iterations > 1) continue;
    rounds.together.push_back(joint), rounds.separate.push_back(sum);
  }
  return compare(rounds, together.integrator->statistics(), job.frames.size());
}

std::string table_of(const Comparison& c, const wg12::Speedups* paper) {
  std::vector<std::string> head = {"step",    "dsppm, s",       fmt::format("{} x sppm, s", c.frames),
                                   "speedup", "sharing factor", "reached"};
  if (paper != nullptr) head.push_back("WG12");
  Table table(head);
  for (std::size_t s = 0; s < kSteps.size(); ++s) {
    std::vector<std::string> cells = {kSteps[s],
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

std::string dynamic_shares(const Comparison& c) {
  return fmt::format("{} of the photon paths and {} of the camera paths met something that differs between frames.",
                     percent_cell(c.dynamic_photons), percent_cell(c.dynamic_hit_points));
}

}  // namespace dspm
