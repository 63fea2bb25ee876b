// A ray's hit on one primitive, as every tree and the brute force loop compute it: the shape's own test, with one
// correction. The hit decision for a triangle seen edge-on is sound, but its rounded distance is poor and may even lie
// before the ray reaches the triangle's box; then a tree that culls boxes by distance and a loop over all primitives
// would disagree. Such a hit is moved to where the ray enters the box.
#pragma once

#include "dspm/accel/box_ray.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/beyond_hole.h"
#include "dspm/shapes/surface_geometry.h"
#include "dspm/shapes/triangle.h"

namespace dspm {

/// Moves the hit; returns whether it is still before t_max.
constexpr bool move_to_entry(PrimitiveHit& hit, const BoxRay& ray, const Bounds3& bounds, float t_max) {
  const float entry = ray.entry(with_margin(bounds));
  if (entry > hit.t && entry < kInfinity) hit.t = entry;
  return hit.t < t_max;
}
constexpr std::optional<PrimitiveHit> not_before_entry(PrimitiveHit hit, const BoxRay& ray, const Bounds3& bounds,
                                                       float t_max) {
  return move_to_entry(hit, ray, bounds, t_max) ? std::optional<PrimitiveHit>(hit) : std::nullopt;
}

/// Returns the hit; `ray` is in the shape's space. AnyShape is Shape or PlainShape.
template <class AnyShape>
constexpr std::optional<PrimitiveHit> meet(const AnyShape& shape, int primitive, const Ray& ray) {
  const std::optional<PrimitiveHit> hit = shape.intersect(primitive, ray);
  return hit ? not_before_entry(*hit, BoxRay(ray), shape.bounds(primitive), ray.t_max) : std::nullopt;
}

/// Returns the first hit that stops the ray: for which stops(uv) holds. A hit beyond `limit` may be one that does not stop
/// it.
template <class AnyShape, class Stops>
constexpr std::optional<PrimitiveHit> first_stop(const AnyShape& shape, int primitive, const Ray& ray, float limit,
                                                 const Stops& stops) {
  const auto met = [&](const Ray& part) { return meet(shape, primitive, part); };
  std::optional<PrimitiveHit> hit = met(ray);
  while (hit && hit->t <= limit && !stops(hit->uv)) {
    hit = meet_beyond(shape, primitive, ray, *hit, met);
    if (hit) hit = not_before_entry(*hit, BoxRay(ray), shape.bounds(primitive), ray.t_max);
  }
  return hit;
}

/// A ray prepared for triangles and their boxes.
struct MeshRay {
  TriangleRay triangle;
  BoxRay box;
  float t_max;

  constexpr explicit MeshRay(const Ray& ray) : triangle(ray), box(ray), t_max(ray.t_max) {}
};

/// Returns whether meet() returns a hit for the same triangle of a mesh, and sets it.
constexpr bool meet(const MeshRay& ray, const Vec3& p0, const Vec3& p1, const Vec3& p2, PrimitiveHit& hit) {
  return intersect(ray.triangle, p0, p1, p2, ray.t_max, hit) &&
         move_to_entry(hit, ray.box, {min(min(p0, p1), p2), max(max(p0, p1), p2)}, ray.t_max);
}
constexpr std::optional<PrimitiveHit> meet(const MeshRay& ray, const Vec3& p0, const Vec3& p1, const Vec3& p2) {
  PrimitiveHit hit;
  return meet(ray, p0, p1, p2, hit) ? std::optional<PrimitiveHit>(hit) : std::nullopt;
}

}  // namespace dspm
