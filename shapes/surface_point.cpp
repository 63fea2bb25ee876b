#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/shape.h"

namespace dspm {

// p's error box reaches |nx| ex + |ny| ey + |nz| ez along the normal. [Pharr, Jakob, Humphreys, Physically Based
// Rendering, 6.8.6] The box is widened by what rounding p + offset may take back: half a unit in the last place of p,
// and of the offset.
Ray SurfacePoint::spawn(const Vec3& w, float t_max) const {
  const float distance = dot(abs(ng), p_error * (1 + 0x1p-20f) + abs(p) * 0x1p-22f);
  return {p + ng * (dot(w, ng) < 0 ? -distance : distance), w, t_max};
}

void SurfacePoint::cover(const Vec3& w, float diameter) {
  constexpr float kLeastCosine = 1e-4f;  // a surface that is seen edge-on has no end
  const float cosine = dot(w, ng);
  const Vec3 away = Basis::around(ng, w).x;
  dpdx = cross(ng, away) * diameter;
  dpdy = away * (diameter / std::max(std::abs(cosine), kLeastCosine));
}

}  // namespace dspm
