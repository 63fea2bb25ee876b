// The opening of a thin lens: a circle, or what the blades of an aperture leave of it, which is seen in every highlight out of
// focus.
#pragma once

#include <algorithm>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"

namespace dspm {

struct Blades {
  int count = 0;                // 0: a circle
  float rotation = 0;           // radians, from x towards y
  float width = 1, height = 1;  // of the opening, as shares of the circle's

  /// The numbers for which a round lens has the place that belongs to `u` in the opening; even over its area.
  constexpr Vec2 within(Vec2 u) const {
    if (count == 0 && width == height) return u;
    const Vec2 place = count == 0 ? concentric_disk(u) : in_polygon(u);
    return concentric_disk_numbers({place.x * width, place.y * height});
  }

 private:
  /// Of a regular polygon in the unit circle, one of whose edges has its middle in the direction of `rotation`.
  constexpr Vec2 in_polygon(Vec2 u) const {
    const auto corners = static_cast<float>(count);
    const float wedge = std::min(static_cast<float>(static_cast<int>(u.x * corners)), corners - 1);
    const float out = rounded::sqrt(std::clamp(u.x * corners - wedge, 0.f, 1.f));
    const float half = kPi / corners, middle = rotation + 2 * half * wedge;
    const rounded::SinCos first = rounded::sin_cos(middle - half), second = rounded::sin_cos(middle + half);
    return (Vec2{first.cos, first.sin} * (1 - u.y) + Vec2{second.cos, second.sin} * u.y) * out;
  }
};

}  // namespace dspm
