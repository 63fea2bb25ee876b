#include "dspm/output/report/scaling_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/output/report/run_report.h"

namespace dspm {
namespace {

/// Returns the part of the iterations that belongs to none of their steps.
StepTime the_rest(const StepTime& iterations, const std::vector<StepTime>& steps) {
  StepTime rest = iterations;
  rest.name = "rest of iterations";
  for (const StepTime& step : steps) rest.seconds -= step.seconds, rest.work -= step.work;
  rest.work = {std::max(rest.work.all, 0.0), std::max(rest.work.span, 0.0)};
  return rest;
}

}  // namespace

std::vector<StepTime> worked_steps(const std::vector<StepTime>& around, const std::vector<StepTime>& steps) {
  std::vector<StepTime> all;
  for (const StepTime& step : around) {
    if (step.name == kIterations) {
      all.insert(all.end(), steps.begin(), steps.end());
      all.push_back(the_rest(step, steps));
    }
    all.push_back(step);
  }
  std::erase_if(all, [](const StepTime& step) { return step.work.all <= 0; });
  return all;
}

std::string scaling_table(const std::vector<StepTime>& around, const std::vector<StepTime>& steps) {
  constexpr int kThreads[] = {16, 64, 128};
  const std::vector<StepTime> all = worked_steps(around, steps);
  if (all.empty()) return {};
  std::string text = fmt::format("  {:<24}{:>16}{:>10}", "speedup by threads", "processor s", "serial");
  for (const int threads : kThreads) text += fmt::format("{:>8}", threads);
  for (const StepTime& step : all) {
    text += fmt::format("\n  {:<24}{:>16.2f}{:>9.2f}%", step.name, step.work.all, 100 * step.work.serial_share());
    for (const int threads : kThreads) text += fmt::format("{:>8.1f}", step.work.speedup(threads));
  }
  return text + "\n\n";
}

}  // namespace dspm
