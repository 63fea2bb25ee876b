// If things move fast, an iteration shows several moments of the shutter, and each pixel sees one of them: neighbours see
// others, so that after few iterations no copies of what moves are seen, but a streak with noise.
#pragma once

#include <cmath>

namespace dspm {

/// The pixels of the full image that see one of `count` moments, in a pattern without rows. [Roberts 2018, The Unreasonable
/// Effectiveness of Quasirandom Sequences: R2]
struct MomentPixels {
  int moment = 0, count = 1;

  bool contain(int x, int y) const {
    if (count == 1) return true;
    const double place = 0.7548776662466927 * x + 0.5698402909980532 * y;
    return static_cast<int>((place - std::floor(place)) * count) == moment;
  }
};

}  // namespace dspm
