// The report of a run: what was rendered, how long each step took, what the frames shared. It is a table for people, or
// JSON for programs.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/integrators/statistics.h"
#include "dspm/session/job/job.h"

namespace dspm {

/// The step of RunReport::around that holds the integrator's steps.
inline constexpr const char* kIterations = "iterations";

/// The traffic between machines that rendered together.
struct Traffic {
  int machines = 0;  // 0: the run knew no others
  std::uint64_t bytes = 0;
  std::uint64_t iterations = 0;  // of this run, each as often as it has frames

  std::uint64_t bytes_an_iteration_and_frame() const { return iterations == 0 ? 0 : bytes / iterations; }
};

struct RunReport {
  std::vector<int> iterations;  // done, by frame interval
  double seconds = 0;           // from the start of the first iteration to the last image written
  int threads = 0;
  std::size_t tree_bytes = 0;  // of the largest interval's trees
  int exit_code = 0;
  std::vector<StepTime> around;        // reading the scene, all iterations, writing, ...
  Statistics statistics;               // all intervals together
  std::vector<FileFrame> frames;       // of the energy balances, in their order
  std::map<FileFrame, double> errors;  // estimated
  Traffic traffic;

  /// Adds the work of the integrator of an interval of these frames.
  void add(const Statistics& interval, const std::vector<FileFrame>& of_interval);
};

std::string table_of(const Job& job, const RunReport& report);
std::string json_of(const Job& job, const RunReport& report);

}  // namespace dspm
