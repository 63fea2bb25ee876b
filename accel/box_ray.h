// Rays against boxes, without losing a hit. A primitive test rounds: it may accept a ray that misses the box by a few
// roundings of the coordinates involved. So boxes and the ray's origin get a margin of kBoxMargin times their largest
// coordinate. And since the arithmetic below is monotonic, bit for bit, a ray never enters a box later than one inside
// it: a tree never culls a hit that is not before the entry of its primitive's own box (see meet.h).
#pragma once

#include <array>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// 16 roundings: the watertight triangle test takes 6 for shearing, a plane's distance 3.
inline constexpr float kBoxMargin = 0x1p-20f;

constexpr float largest_coordinate(const Bounds3& b) { return max_component(max(abs(b.low), abs(b.high))); }

constexpr Bounds3 widened(const Bounds3& b, float by) {
  const Vec3 margin{by, by, by};
  return {b.low - margin, b.high + margin};
}

/// The box that trees use for a primitive, or for anything in the same space as the ray.
constexpr Bounds3 with_margin(const Bounds3& b) { return widened(b, kBoxMargin * largest_coordinate(b)); }

/// A ray prepared for boxes with margin. Along each axis, the near plane is the high one if the direction is negative.
struct BoxRay {
  std::array<bool, 3> negative;
  Vec3 near_origin, far_origin;  // moved by its margin so that the ray enters boxes earlier and leaves them later
  Vec3 inverse;                  // of the direction; infinite along an axis to which the ray is perpendicular

  /// `margins` is the number of margins of the origin; see Tree::margins for more than one.
  constexpr explicit BoxRay(const Ray& ray, float margins = 1) {
    const float margin = margins * kBoxMargin * max_component(abs(ray.origin));
    for (int axis = 0; axis < 3; ++axis) {
      const float d = ray.direction[axis], shift = rounded::is_negative(d) ? -margin : margin;
      negative[static_cast<std::size_t>(axis)] = rounded::is_negative(d);
      near_origin[axis] = ray.origin[axis] + shift;
      far_origin[axis] = ray.origin[axis] - shift;
      inverse[axis] = 1 / d;
    }
  }

  /// Returns where the ray's line enters the box, at least 0. Ignores an axis on which 0 is multiplied by infinity.
  constexpr float entry(const Bounds3& box) const {
    float t = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float plane = negative[static_cast<std::size_t>(axis)] ? box.high[axis] : box.low[axis];
      const float at = (plane - near_origin[axis]) * inverse[axis];
      t = at > t ? at : t;
    }
    return t;
  }
};

}  // namespace dspm
