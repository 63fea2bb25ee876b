// The size of the region in which photons are gathered around a point of a surface.
#pragma once

#include "dspm/math/vec.h"

namespace dspm {

/// The area of a disc, times `times`. A volume would have a ball. [WG12 (5)]
inline float kernel_size(float radius2, float times = 1) { return times * kPi * radius2; }

}  // namespace dspm
