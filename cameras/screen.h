// The screen window, and the film's pixels on it, in camera space: x to the right, y up.
#pragma once

#include "dspm/base/math/vec.h"

namespace dspm {

struct Screen {
  float left = -1, right = 1, bottom = -1, top = 1;
  int width = 1, height = 1;  // of the film, in pixels

  constexpr Vec2 at(Vec2 film) const {
    return {left + film.x / static_cast<float>(width) * (right - left),
            top - film.y / static_cast<float>(height) * (top - bottom)};
  }
  /// The inverse of at().
  constexpr Vec2 film_at(Vec2 s) const {
    return {(s.x - left) / (right - left) * static_cast<float>(width),
            (top - s.y) / (top - bottom) * static_cast<float>(height)};
  }
  constexpr Vec2 pixel_size() const {
    return {(right - left) / static_cast<float>(width), (top - bottom) / static_cast<float>(height)};
  }
};

}  // namespace dspm
