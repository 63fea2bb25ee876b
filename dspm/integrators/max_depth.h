// How long paths may be, for the factories of integrators.
#pragma once

#include <string>

#include "dspm/params/params.h"

namespace dspm {

/// An error of the parameter where it is less than `least`, or so much that, where nothing absorbs, a path would be
/// under way for longer than a Ctrl-C waits.
inline void check_max_depth(ParamReader& params, int max_depth, int least) {
  constexpr int kMost = 10'000;
  if (max_depth < least || max_depth > kMost)
    params.error("maxdepth", "maxdepth must lie between " + std::to_string(least) + " and " + std::to_string(kMost));
}

}  // namespace dspm
