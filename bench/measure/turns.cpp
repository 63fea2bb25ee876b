#include "bench/measure/turns.h"

#include <algorithm>

#include "bench/report/progress.h"
#include "bench/report/table.h"

namespace dspm {
namespace {

/// A group's joint run and what was measured of it, iteration by iteration.
struct Group {
  const std::vector<Frame>* frames;
  Run run;
  std::vector<StepSeconds> together, separate;
};

StepSeconds ratios(const std::vector<StepSeconds>& separate, const std::vector<StepSeconds>& together) {
  std::vector<StepSeconds> rounds = separate;
  for (std::size_t i = 0; i < rounds.size(); ++i)
    for (std::size_t s = 0; s < kSteps.size(); ++s) rounds[i][s] /= together[i][s];
  return medians(rounds);
}

/// What `frames` take one by one: those that were measured, scaled to all.
StepSeconds sum_over(const std::vector<Frame>& frames, const std::vector<Frame>& measured,
                     const std::vector<StepSeconds>& seconds) {
  StepSeconds sum{};
  int count = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (!std::binary_search(frames.begin(), frames.end(), measured[i])) continue;
    for (std::size_t s = 0; s < sum.size(); ++s) sum[s] += seconds[i][s];
    ++count;
  }
  for (double& value : sum) value *= static_cast<double>(frames.size()) / count;
  return sum;
}

/// The total's speedup if each step reached its factor.
double factor_of_all(const StepSeconds& separate, const StepSeconds& factors) {
  double together = 0;
  for (std::size_t s = 0; s + 1 < kSteps.size(); ++s) together += separate[s] / factors[s];
  return separate.back() / together;
}

Comparison compare(const Group& group) {
  const Statistics s = group.run.integrator->statistics();
  Comparison c;
  c.frames = static_cast<int>(group.frames->size());
  c.together = medians(group.together), c.separate = medians(group.separate);
  c.speedups = ratios(group.separate, group.together);
  c.factors = {s.camera.segments.factor(), s.photon.segments.factor(), s.photons_stored.factor(),
               s.photon_tests.factor(), 0};
  c.factors.back() = factor_of_all(c.separate, c.factors);
  c.dynamic_photons = s.photon.dynamic_share(), c.dynamic_hit_points = s.camera.dynamic_share();
  return c;
}

/// The joint runs stand between the separate ones, evenly.
void take_turn(std::vector<Group>& groups, std::vector<Run>& alone, const std::vector<Frame>& frames, int iteration) {
  std::vector<StepSeconds> separate;
  std::size_t next = 0;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    for (; next < groups.size() && next * alone.size() <= i * groups.size(); ++next)
      groups[next].together.push_back(timed_iteration(*groups[next].run.integrator, iteration));
    separate.push_back(timed_iteration(*alone[i].integrator, iteration));
  }
  for (; next < groups.size(); ++next)
    groups[next].together.push_back(timed_iteration(*groups[next].run.integrator, iteration));
  for (Group& group : groups) group.separate.push_back(sum_over(*group.frames, frames, separate));
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

std::vector<Comparison> take_turns(const LoadedScene& loaded, const Job& job,
                                   std::span<const std::vector<Frame>> frame_groups, const TurnSettings& settings) {
  std::vector<Group> groups;
  for (const std::vector<Frame>& frames : frame_groups)
    groups.push_back({&frames, start(loaded, job, "dsppm", frames), {}, {}});
  const std::vector<Frame> frames = spread_frames(frame_groups.front(), settings.separate);
  std::vector<Run> alone;
  for (const Frame f : frames) alone.push_back(start(loaded, job, "sppm", {f}));

  for (int i = 0; i < settings.iterations; ++i) {
    take_turn(groups, alone, frames, i);
    say("iteration {} of {}: {:.2f} s together, {:.2f} s separately", i + 1, settings.iterations,
        groups.front().together.back().back(), groups.front().separate.back().back());
    if (i > 0 || settings.iterations == 1) continue;
    for (Group& group : groups) group.together.clear(), group.separate.clear();
  }
  std::vector<Comparison> comparisons;
  for (const Group& group : groups) comparisons.push_back(compare(group));
  return comparisons;
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
