// Tests values that light can have, for any plugin.
#pragma once

#include "dspm/base/colour/spectrum.h"

namespace dspm {

/// Returns whether it can be radiance, flux or a factor to them: finite, and never negative.
template <Components T>
constexpr bool is_light(const T& c) {
  return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && is_finite(c);
}

}  // namespace dspm
