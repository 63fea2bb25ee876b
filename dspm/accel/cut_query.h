// Rays and the holes of cut-out shapes: a hit on a hole is no hit.
#pragma once

#include "dspm/accel/hits.h"
#include "dspm/accel/meet.h"
#include "dspm/math/frames.h"
#include "dspm/math/ray.h"
#include "dspm/math/vec.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

/// A query (see traverse.h) that is offered only the hits that stop the ray. `shapes[hit.shape]` are the shapes.
template <class Query>
class CutQuery {
 public:
  static constexpr bool kOneFrame = Query::kOneFrame;
  static constexpr bool kNearestFirst = Query::kNearestFirst;

  CutQuery(Query& query, const Ray& world_ray, const PlacedShape* shapes)
      : query_(query), ray_(world_ray), shapes_(shapes) {}

  FrameSet frames() const { return query_.frames(); }
  float limit() const { return query_.limit(); }
  float limit(FrameSet frames) const { return query_.limit(frames); }
  bool reaches(float entry, FrameSet frames) const { return query_.reaches(entry, frames); }
  void offer(const RayHit& hit, FrameSet frames) {
    // Looking up alpha is dear, so hits that do not matter anyway are left out first.
    if (hit.t <= query_.limit(frames) && shapes_[hit.shape].stops(ray_, hit.primitive, hit.uv))
      query_.offer(hit, frames);
  }

 private:
  Query& query_;
  const Ray& ray_;
  const PlacedShape* shapes_;
};

/// The primitive's next hit after one at `hole`: the ray starts anew there. Both rays are in the shape's space.
inline std::optional<PrimitiveHit> meet_beyond(const Shape& shape, int primitive, const Ray& ray,
                                               const PrimitiveHit& hole) {
  if (shape.triangles() != nullptr) return std::nullopt;  // a line meets a triangle once
  Ray rest = shape.surface_point(primitive, hole.uv).spawn(ray.direction);
  const DoubleVec3 gone = difference(rest.origin, ray.origin), d = widen(ray.direction);
  const auto start = static_cast<float>(dot(gone, d) / dot(d, d));
  rest.t_max = ray.t_max - start;
  const auto next = meet(shape, primitive, rest);
  if (!next || !(start + next->t > hole.t)) return std::nullopt;
  return not_before_entry({start + next->t, next->uv}, BoxRay(ray), shape.bounds(primitive), ray.t_max);
}

/// The first hit of the primitive that stops the ray. `ray`: the same in the shape's space. A hit beyond `limit` may be
/// one that does not stop it.
inline std::optional<PrimitiveHit> first_stop(const PlacedShape& placed, int primitive, const Ray& world_ray,
                                              const Ray& ray, float limit = kInfinity) {
  std::optional<PrimitiveHit> hit = meet(*placed.shape, primitive, ray);
  while (hit && hit->t <= limit && !placed.stops(world_ray, primitive, hit->uv))
    hit = meet_beyond(*placed.shape, primitive, ray, *hit);
  return hit;
}

}  // namespace dspm
