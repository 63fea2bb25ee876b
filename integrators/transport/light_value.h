// Tests values that light can have, for any plugin.
#pragma once

#include "dspm/base/colour/rgb.h"

namespace dspm {

/// Returns whether it can be radiance, flux or a factor to them: finite, and never negative.
inline bool is_light(const Rgb& c) { return c.r >= 0 && c.g >= 0 && c.b >= 0 && is_finite(c); }

}  // namespace dspm
