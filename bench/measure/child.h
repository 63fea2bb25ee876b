// dspm in a process of its own, as its users run it: for what only a whole process shows, its peak memory first of all.
#pragma once

#include <string>
#include <vector>

namespace dspm {

struct ChildReport {
  double seconds = 0;           // from the first iteration's begin to the last image written
  double peak_bytes = 0;        // of the process, by the kernel's account
  double tree_bytes = 0;        // by dspm's own account
  double integrator_bytes = 0;  // likewise: pixels, photons, hit points
};

/// Runs dspm with these arguments; images go to a temporary directory. Throws std::runtime_error with what dspm said
/// where it fails.
ChildReport run_dspm(std::vector<std::string> arguments);

}  // namespace dspm
