// From camera space (x to the right, y up, z forward), which may be turned, mirrored and stretched, to the world.
#pragma once

#include <cmath>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/cameras/sighting.h"

namespace dspm {

/// Carries a ray to the world; the direction is of unit length again.
constexpr Ray carried(const Transform& to_world, const Ray& ray) {
  return {to_world.point(ray.origin), normalize(to_world.vector(ray.direction))};
}

/// Returns a sighting of the camera-space point `p` from `origin`, where an area of 1 perpendicular to the line of
/// sight covers `pixels` at p.
constexpr Sighting carried_across(const Transform& to_world, Vec2 film, const Vec3& p, const Vec3& origin,
                                  float pixels) {
  const Vec3 way = to_world.vector(origin - p), local = normalize(origin - p);
  const Vec3 x = to_world.vector({1, 0, 0}), y = to_world.vector({0, 1, 0}), z = to_world.vector({0, 0, 1});
  // A thin tube along w: its volume scales by the determinant, its length as w does, so its cross-section by the
  // quotient.
  const float section = std::abs(dot(cross(x, y), z)) / length(to_world.vector(local));
  return {film, normalize(way), length(way), pixels / section};
}

/// Returns a sighting where an area of 1 perpendicular to z covers `pixels` at p.
constexpr Sighting carried(const Transform& to_world, Vec2 film, const Vec3& p, const Vec3& origin, float pixels) {
  return carried_across(to_world, film, p, origin, pixels / std::abs(normalize(origin - p).z));
}

/// The edge of a square as large as the rectangle that the camera-space vectors (size.x, 0, 0) and (0, size.y, 0) span
/// in the world.
constexpr float mean_spacing(const Transform& to_world, Vec2 size) {
  return rounded::sqrt(length(cross(to_world.vector({size.x, 0, 0}), to_world.vector({0, size.y, 0}))));
}

}  // namespace dspm
