// The default number of photon paths: one for each pixel.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "dspm/integrators/integrator.h"

namespace dspm {

/// Returns the pixels of the full image, which may be far larger than what is rendered of it; at most 2^31 - 1.
inline int pixel_count(const RenderSettings& render) {
  const std::int64_t count = std::int64_t{render.width} * render.height;
  return static_cast<int>(std::clamp<std::int64_t>(count, 1, std::numeric_limits<int>::max()));
}

}  // namespace dspm
