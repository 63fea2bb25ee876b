// What a camera says of a point whose light is traced towards it.
#pragma once

#include "dspm/base/math/vec.h"

namespace dspm {

/// A point as a camera sees it.
struct Sighting {
  Vec2 film;              // in pixels of the full image; may lie outside it
  Vec3 w;                 // from the point towards the camera, unit length
  float distance;         // to the lens
  float pixels_per_area;  // film covered per area at the point, perpendicular to w
};

}  // namespace dspm
