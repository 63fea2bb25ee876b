// The size of the region in which photons are gathered around a point of a surface.
#pragma once

#include "dspm/base/math/vec.h"

namespace dspm {

/// Returns the area of a disc times the number of photon paths. [WG12 (5)]
inline float kernel_size(float radius2, float paths = 1) { return paths * kPi * radius2; }

}  // namespace dspm
