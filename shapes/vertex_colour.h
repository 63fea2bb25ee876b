// The colours of vertices in mesh files that store them as pictures do.
#pragma once

#include <cmath>

namespace dspm {

/// Returns the linear light of a value in 0..1 of sRGB. [IEC 61966-2-1]
inline float linear_of_srgb(double c) {
  return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

}  // namespace dspm
