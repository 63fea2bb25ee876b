// Loops over the pixels of an image, and over the pixels around one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "dspm/base/system/parallel.h"
#include "dspm/image/image.h"

namespace dspm {

/// Calls fn(index of the pixel, x, y) on many threads.
template <class Fn>
void for_each_pixel(const Image& image, const Fn& fn) {
  constexpr int kRows = 8;
  parallel_for(image.height, kRows, [&](std::int64_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < image.width; ++x) fn(image.index(x, y), x, y);
  });
}

/// Calls fn(index) for the pixels of a square around one, as far as they are within the image.
template <class Fn>
void around(const Image& image, int x, int y, int radius, const Fn& fn) {
  for (int v = std::max(y - radius, 0); v <= std::min(y + radius, image.height - 1); ++v)
    for (int u = std::max(x - radius, 0); u <= std::min(x + radius, image.width - 1); ++u) fn(image.index(u, v));
}

}  // namespace dspm
