// From one thread to all of the machine, step by step, dsppm on all frames and sppm on one.
#include <algorithm>
#include <thread>

#include "bench/measure/turns.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

/// 1, 2, 4, ... and all.
std::vector<int> thread_counts() {
  const int all = std::max(2, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<int> counts;
  for (int count = 1; count < all; count *= 2) counts.push_back(count);
  counts.push_back(all);
  return counts;
}

/// Medians for each number of threads; all take turns on runs of their own.
std::vector<StepSeconds> measure(const LoadedScene& loaded, const char* integrator,
                                 const std::vector<FileFrame>& frames, int iterations) {
  const std::vector<int> counts = thread_counts();
  std::vector<Run> runs;
  for (std::size_t i = 0; i < counts.size(); ++i) runs.push_back(start(loaded, loaded.job, integrator, frames));
  std::vector<std::vector<StepSeconds>> seconds(counts.size());
  for (int iteration = 0; iteration < iterations; ++iteration) {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const ThreadLimit limit(counts[i]);
      const StepSeconds taken = timed_iteration(runs[i], iteration);
      if (iteration > 0) seconds[i].push_back(taken);
    }
    say("{}: iteration {} of {}", integrator, iteration + 1, iterations);
  }
  std::vector<StepSeconds> result;
  for (const std::vector<StepSeconds>& rounds : seconds) result.push_back(medians(rounds));
  return result;
}

std::string table_of(const std::vector<StepSeconds>& seconds) {
  const std::vector<int> counts = thread_counts();
  std::vector<std::string> head = {"step", "1 thread, s"};
  for (std::size_t i = 1; i < counts.size(); ++i)
    head.insert(head.end(), {fmt::format("{} threads, s", counts[i]), "speedup"});
  Table table(head);
  for (std::size_t s = 0; s < kStepNames.size(); ++s) {
    std::vector<std::string> cells = {kStepNames[s], seconds_cell(seconds[0][s])};
    for (std::size_t i = 1; i < counts.size(); ++i)
      cells.insert(cells.end(), {seconds_cell(seconds[i][s]), ratio_cell(seconds[0][s] / seconds[i][s])});
    table.row(cells);
  }
  return table.text();
}

}  // namespace

Findings measure_threads(const Setup& setup) {
  const LoadedScene loaded = setup.scene.empty() ? load(our_scene("horse")) : load(setup.scene, setup.defines);
  const int iterations = setup.quick ? 3 : 8;
  const std::vector<FileFrame>& frames = loaded.job.frames;
  const auto together = measure(loaded, "dsppm", frames, iterations);
  const auto alone = measure(loaded, "sppm", {frames[frames.size() / 2]}, 2 * iterations);
  return {fmt::format("`dsppm`, {} frames:\n\n{}\n`sppm`, one frame:\n\n{}", frames.size(), table_of(together),
                      table_of(alone)),
          {}};
}

}  // namespace dspm
