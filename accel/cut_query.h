// Rays and the holes of cut-out shapes: a hit on a hole is no hit.
#pragma once

#include "dspm/accel/hits.h"
#include "dspm/accel/meet.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
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

/// Returns the first hit of the primitive that stops the ray. `ray` is `world_ray` in the shape's space. A hit beyond
/// `limit` may be one that does not stop it.
inline std::optional<PrimitiveHit> first_stop(const PlacedShape& placed, int primitive, const Ray& world_ray,
                                              const Ray& ray, float limit = kInfinity) {
  return first_stop(*placed.shape, primitive, ray, limit,
                    [&](Vec2 uv) { return placed.stops(world_ray, primitive, uv); });
}

}  // namespace dspm
