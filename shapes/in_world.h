// From a shape's own space to the world: its surface, with bounds on rounding, and its areas. For CPUs and GPUs.
#pragma once

#include "dspm/base/math/rounding.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

/// Returns |M| v for a linear map M: the image of an error box.
template <class Map>
constexpr Vec3 absolute(const Map& map, const Vec3& v) {
  return abs(map(Vec3{1, 0, 0})) * v.x + abs(map(Vec3{0, 1, 0})) * v.y + abs(map(Vec3{0, 0, 1})) * v.z;
}

/// Bound on the world-space error of a point that is transformed to the world and back to object space: each matrix is
/// rounded (one rounding per entry) and applied (three), and they are inverse to each other up to that.
constexpr Vec3 round_trip_error(const Transform& t, const Vec3& p_object, const Vec3& p_world) {
  const auto forward = [&](const Vec3& v) { return t.vector(v); };
  const auto backward = [&](const Vec3& v) { return t.inverse_vector(v); };
  const Vec3 back = absolute(backward, abs(p_world)) + abs(t.inverse_point({}));
  return 2 * t.point_error(p_object) + gamma_bound(5) * absolute(forward, back);
}

constexpr void move_to_world(SurfaceGeometry& s, const Transform& to_world) {
  const Vec3 p = to_world.point(s.p);
  s.p_error =
      absolute([&](const Vec3& v) { return to_world.vector(v); }, s.p_error) + round_trip_error(to_world, s.p, p);
  s.p = p;
  s.ng = normalize(to_world.normal(s.ng));
  s.ns = normalize(to_world.normal(s.ns));
  if (!(dot(s.ns, s.ng) > 0)) s.ns = s.ng;
  s.dpdu = to_world.vector(s.dpdu), s.dpdv = to_world.vector(s.dpdv);
}

/// For shapes with ReverseOrientation.
constexpr void flip_normals(SurfaceGeometry& s) { s.ng = -s.ng, s.ns = -s.ns; }

/// The factor from object to world area at a point whose object-space unit normal is n.
constexpr float area_scale(const Transform& to_world, const Vec3& n) {
  const Basis tangents = Basis::around(n);
  return length(cross(to_world.vector(tangents.x), to_world.vector(tangents.y)));
}

/// Returns the object-space unit normal of a point whose normal in the world is ng.
constexpr Vec3 own_normal(const Transform& to_world, const Vec3& ng) {
  return normalize(
      {dot(ng, to_world.vector({1, 0, 0})), dot(ng, to_world.vector({0, 1, 0})), dot(ng, to_world.vector({0, 0, 1}))});
}

}  // namespace dspm
