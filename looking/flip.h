// FLIP: how different two images look when one flips between them. [Andersson et al. 2020, FLIP: A Difference Evaluator
// for Alternating Images]
#pragma once

#include <vector>

#include "dspm/image/image.h"

namespace dspm {

/// The resolution of a 4K screen 0.7 m wide, seen from 0.7 m.
inline constexpr double kUsualPixelsPerDegree = 67.0206;

/// Returns a number for each pixel, from 0 (the same) to 1. Both images are as a screen shows them: linear, in 0..1, of
/// one size.
std::vector<float> flip(const Image& reference, const Image& test, double pixels_per_degree = kUsualPixelsPerDegree);

}  // namespace dspm
