// dspm in a process of its own, as its users run it: to measure what only a whole process shows, above all its peak
// memory.
#pragma once

#include <string>
#include <vector>

namespace dspm {

struct ChildReport {
  double seconds = 0;           // from the start of the first iteration to the last image written
  double peak_bytes = 0;        // of the process, as the kernel counts
  double tree_bytes = 0;        // as dspm counts
  double integrator_bytes = 0;  // likewise: pixels, photons, hit points
};

/// Runs dspm with these arguments; images go to a temporary directory. Throws std::runtime_error with dspm's messages
/// if it fails.
ChildReport run_dspm(std::vector<std::string> arguments);

}  // namespace dspm
