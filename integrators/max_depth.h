// Checks the maximum path length, for the factories of integrators.
#pragma once

#include <string>

#include "dspm/base/params/params.h"

namespace dspm {

/// Reports an error if the parameter is less than `least`, or so large that, in a scene that absorbs nothing, tracing
/// one path would take longer than a Ctrl-C waits.
inline void check_max_depth(ParamReader& params, int max_depth, int least) {
  constexpr int kMost = 10'000;
  if (max_depth < least || max_depth > kMost)
    params.error("maxdepth", "maxdepth must lie between " + std::to_string(least) + " and " + std::to_string(kMost));
}

}  // namespace dspm
