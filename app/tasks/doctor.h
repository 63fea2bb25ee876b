// Checks the installation.
#pragma once

#include <string>

namespace dspm {

struct Diagnosis {
  std::string text;
  bool can_render;
};

/// Renders four pixels whose radiance is known, and looks at the machine and at what else dspm can use. Takes a second
/// or two. `threads` as of --nthreads.
Diagnosis examine_installation(int threads);

}  // namespace dspm
