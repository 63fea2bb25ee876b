// A lens in the plane z = 0 of the ray's origin; the image is sharp in the plane z = focal_distance.
#pragma once

#include "dspm/base/math/ray.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/cameras/blades.h"

namespace dspm {

struct ThinLens {
  float radius = 0, focal_distance = 1e6f;
  Blades blades = {};  // its opening, within the radius

  /// Returns the ray through another point of the lens that meets `central` in the plane of focus.
  constexpr Ray through(const Ray& central, Vec2 u) const {
    if (!(radius > 0)) return central;
    const Vec3 focus = central.at(focal_distance / central.direction.z), origin = central.origin + offset(u);
    return {origin, normalize(focus - origin)};
  }
  /// Returns that point of the lens, relative to its middle.
  constexpr Vec3 offset(Vec2 u) const {
    if (!(radius > 0)) return {};
    const Vec2 place = concentric_disk(blades.within(u)) * radius;
    return {place.x, place.y, 0};
  }
};

}  // namespace dspm
