// A mapping says how an image covers the sphere of directions. Places are in the unit square, x to the right and y
// down.
#pragma once

#include "dspm/base/math/vec.h"

namespace dspm {

enum class SphereMapping {
  equal_area,       // octahedral, pbrt-v4's: +z in the middle, -z in the corners [Clarberg 2008, 3]
  equirectangular,  // azimuth from +x over +y to the right, polar angle from +z down (latitude and longitude)
};

/// Returns the unit vector seen at a place.
Vec3 direction_at(SphereMapping mapping, Vec2 place);
/// Returns the place in [0,1]^2 at which a unit vector is seen.
Vec2 place_of(SphereMapping mapping, const Vec3& direction);

}  // namespace dspm
