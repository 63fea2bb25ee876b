// Where a ray meets a primitive, and how the surface lies there: plain data, which a GPU shares with the CPU.
#pragma once

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// The hit of a ray on a primitive: distance in units of the ray's direction, and the place on the primitive.
struct PrimitiveHit {
  float t;
  Vec2 uv;  // on the primitive: barycentrics of a triangle's second and third vertex, angles of a sphere, ...
};

/// How a surface lies at one of its points.
struct SurfaceGeometry {
  Vec3 p;
  Vec3 p_error;  // bound on the rounding error of p, per coordinate
  Vec3 ng;       // geometric normal, unit length, pointing outward
  Vec3 ns;       // shading normal, unit length, in the half space of ng
  Vec3 dpdu;     // derivative of p by uv.x; any tangent, not zero, if dpdv is zero
  Vec2 uv;       // texture coordinates
  Vec3 dpdv{};   // derivative of p by uv.y; zero if a shape does not know it: lookups by uv are then not filtered

  /// A ray that leaves the surface in direction w (unit length), from a point further off p than its error, on w's side
  /// of ng.
  constexpr Ray spawn(const Vec3& w, float t_max = kInfinity) const {
    // p's error box reaches |nx| ex + |ny| ey + |nz| ez along the normal. [Pharr, Jakob, Humphreys, Physically Based
    // Rendering, 6.8.6] The box is widened by what rounding p + offset may take back: half a unit in the last place of
    // p, and of the offset.
    const float distance = dot(abs(ng), p_error * (1 + 0x1p-20f) + abs(p) * 0x1p-22f);
    return {p + ng * (dot(w, ng) < 0 ? -distance : distance), w, t_max};
  }
};

constexpr bool is_finite(const SurfaceGeometry& point) {
  return is_finite(point.p) && is_finite(point.ng) && is_finite(point.ns);
}

}  // namespace dspm
