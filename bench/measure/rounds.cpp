#include "bench/measure/rounds.h"

#include "bench/report/progress.h"

namespace dspm {
namespace {

template <class Value>
StepSeconds median_of_each(const Rounds& rounds, Value&& value) {
  StepSeconds result{};
  for (std::size_t s = 0; s < kStepNames.size(); ++s) {
    std::vector<double> values;
    for (std::size_t round = 0; round < rounds.size(); ++round) values.push_back(value(round, s));
    result[s] = median(values);
  }
  return result;
}

StepSeconds mean_iteration(const Group& group, int iteration) {
  StepSeconds mean{};
  for (const Run& run : group) {
    const StepSeconds taken = timed_iteration(run, iteration);
    for (std::size_t s = 0; s < mean.size(); ++s) mean[s] += taken[s] / static_cast<double>(group.size());
  }
  return mean;
}

}  // namespace

StepSeconds timed_iteration(const Run& run, int iteration) {
  Integrator& integrator = *run.integrator;
  const Statistics before = integrator.statistics();
  integrator.iterate({iteration, *run.scene});
  const Statistics after = integrator.statistics();
  StepSeconds seconds{};
  for (std::size_t i = 0; i < after.steps.size(); ++i) {
    const double taken = after.steps[i].seconds - before.steps[i].seconds;
    for (std::size_t s = 0; s + 1 < kStepNames.size(); ++s)
      if (after.steps[i].name == kStepNames[s]) seconds[s] += taken;
    seconds.back() += taken;
  }
  return seconds;
}

StepSeconds medians(const Rounds& rounds) {
  return median_of_each(rounds, [&](std::size_t round, std::size_t s) { return rounds[round][s]; });
}

StepSeconds ratios(const Rounds& over, const Rounds& under) {
  return median_of_each(over, [&](std::size_t round, std::size_t s) { return over[round][s] / under[round][s]; });
}

std::vector<Rounds> in_turns(const std::vector<Group>& groups, int iterations) {
  std::vector<Rounds> seconds(groups.size());
  for (int i = 0; i < iterations; ++i) {
    std::string words;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const StepSeconds taken = mean_iteration(groups[g], i);
      words += fmt::format(" {:.2f}", taken.back());
      if (i > 0 || iterations == 1) seconds[g].push_back(taken);
    }
    say("iteration {} of {}:{} s", i + 1, iterations, words);
  }
  return seconds;
}

}  // namespace dspm
