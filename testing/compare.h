// Measures how far two images are apart, over all pixels and channels; for dspm's tests and those of its plugins.
#pragma once

#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/image.h"

namespace dspm {

Rgb mean(const Image& image);
/// Throws std::invalid_argument if the sizes differ, as do all functions below.
double root_mean_squared_error(const Image& image, const Image& reference);
/// Returns the mean of (a - b)^2 / (b^2 + 0.01), b being the reference.
double relative_mean_squared_error(const Image& image, const Image& reference);
double max_difference(const Image& image, const Image& reference);

/// The means over one square of a grid over the image (smaller at the right and lower border).
struct TileMeans {
  int x, y;  // the upper left pixel
  Rgb image, reference;
};
std::vector<TileMeans> compare_tiles(const Image& image, const Image& reference, int tile_size);

}  // namespace dspm
