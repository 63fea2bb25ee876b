#include "dspm/shapes/curvature.h"

#include <cmath>

namespace dspm {

// Twice the mean curvature H is the rate at which a piece of the surface grows as it moves along its normals:
// (dp1 + t dn1) x (dp2 + t dn2) . n = (1 + 2 H t + ...) dp1 x dp2 . n. The differences lead into the primitive.
float mean_curvature(const PlacedShape& shape, int primitive, Vec2 uv) {
  constexpr float kStep = 1.f / 128;
  const float du = uv.x > 0.5f ? -kStep : kStep, dv = uv.y > 0.5f || uv.x + uv.y > 0.98f ? -kStep : kStep;
  const SurfacePoint here = shape.surface_point(primitive, uv);
  const SurfacePoint by_u = shape.surface_point(primitive, {uv.x + du, uv.y});
  const SurfacePoint by_v = shape.surface_point(primitive, {uv.x, uv.y + dv});
  const Vec3 p1 = by_u.p - here.p, p2 = by_v.p - here.p, n1 = by_u.ns - here.ns, n2 = by_v.ns - here.ns;
  const float twice = dot(cross(n1, p2) + cross(p1, n2), here.ns) / dot(cross(p1, p2), here.ns);
  return std::isfinite(twice) ? twice / 2 : 0;
}

}  // namespace dspm
