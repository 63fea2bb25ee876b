#include "shapes/rounding.h"
#include "shapes/shape.h"

namespace dspm {

// p's error box reaches |nx| ex + |ny| ey + |nz| ez along the normal; rounding then goes away from the surface.
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 6.8.6]
Ray SurfacePoint::spawn(const Vec3& w, float t_max) const {
  const float distance = dot(abs(ng), p_error);
  const Vec3 offset = ng * (dot(w, ng) < 0 ? -distance : distance);
  Vec3 origin = p + offset;
  for (int i = 0; i < 3; ++i)
    if (offset[i] != 0) origin[i] = offset[i] > 0 ? next_up(origin[i]) : next_down(origin[i]);
  return {origin, w, t_max};
}

}  // namespace dspm
