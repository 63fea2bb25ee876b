// How noisy an image is: its squared distance from another one, relative to the brightness there.
#pragma once

#include "dspm/image/image.h"

namespace dspm {

/// The mean over pixels and channels of (a - b)^2 / (t + 1% of the truth's mean)^2, where t is the truth's luminance,
/// at most 1 each: relative, because dark areas are seen too, and bounded, because single fireflies would dominate.
///   a an image, b the truth:     its squared error, bias and all
///   a and b of different seeds:  twice its variance, whatever the truth
double relative_square(const Image& a, const Image& b, const Image& truth);

/// Likewise of (a - b) (a - c), between -1 and 1. b and c two references that share no noise: the squared error of a, free
/// of theirs.
double relative_product(const Image& a, const Image& b, const Image& c, const Image& truth);

}  // namespace dspm
