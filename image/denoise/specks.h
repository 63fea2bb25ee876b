// Single pixels that a rare path has made far brighter than all around them.
#pragma once

#include "dspm/image/image.h"

namespace dspm {

/// The radiance and its variance, where a speck becomes as bright and as uncertain as the brightest of its neighbours.
struct Unspecked {
  Image radiance, variance;
};

/// A speck exceeds its neighbours by far more than their noise, but by no more than its own: a lamp or a highlight is
/// certain of its brightness, and what is one path of many is not. Pixels are compared after division by `divisors`, so
/// that no texture has specks.
Unspecked without_specks(const Image& radiance, const Image& variance, const Image& divisors);

}  // namespace dspm
