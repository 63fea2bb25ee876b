// The pixels of a crop in square tiles: neighbours are traced together, and a tile is one unit of parallel work.
#pragma once

#include <algorithm>

#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/dimension.h"
#include "dspm/integrators/integrator.h"

namespace dspm {

inline int tile_count(const PixelRect& crop, int side) {
  return ((crop.width() + side - 1) / side) * ((crop.height() + side - 1) / side);
}

/// Calls fn(x, y), in the full image, for each pixel of tile t.
template <class Fn>
void for_each_pixel_of_tile(const PixelRect& crop, int side, int t, Fn&& fn) {
  const int columns = (crop.width() + side - 1) / side;
  const int x0 = crop.x0 + t % columns * side, y0 = crop.y0 + t / columns * side;
  for (int y = y0; y < std::min(y0 + side, crop.y1); ++y)
    for (int x = x0; x < std::min(x0 + side, crop.x1); ++x) fn(x, y);
}

/// A camera path's position on the film, in pixels of the full image.
inline Vec2 film_point(const RenderSettings& render, int x, int y, const PathRandom& random) {
  const Vec2 offset = render.jitter ? render.filter->sample(random.pair(0, kLightPoint)) : Vec2{};
  return Vec2{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f} + offset;
}

/// A pixel's number in the full image: the index of its camera paths, so that a crop equals the same pixels of the full
/// image.
inline std::uint64_t camera_path_index(const RenderSettings& render, int x, int y) {
  return static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(render.width) + static_cast<std::uint64_t>(x);
}
inline int pixel_in_crop(const PixelRect& crop, int x, int y) { return (y - crop.y0) * crop.width() + (x - crop.x0); }

}  // namespace dspm
