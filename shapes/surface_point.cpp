#include "dspm/base/math/vec.h"
#include "dspm/shapes/shape.h"

namespace dspm {

void SurfacePoint::cover(const Vec3& w, float diameter) {
  constexpr float kLeastCosine = 1e-4f;  // a surface that is seen edge-on has no end
  const float cosine = dot(w, ng);
  const Vec3 away = Basis::around(ng, w).x;
  dpdx = cross(ng, away) * diameter;
  dpdy = away * (diameter / std::max(std::abs(cosine), kLeastCosine));
}

}  // namespace dspm
