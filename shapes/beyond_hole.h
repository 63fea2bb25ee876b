// Finds what a ray meets of a primitive after it has passed through a hole in it.
#pragma once

#include <optional>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

/// Returns the primitive's next hit after the one at `hole`, in units of the ray, which is in the shape's space: it
/// starts anew from the surface there. `meet(ray)` finds the nearest hit of the primitive. AnyShape is Shape or
/// PlainShape.
template <class AnyShape, class Meet>
constexpr std::optional<PrimitiveHit> meet_beyond(const AnyShape& shape, int primitive, const Ray& ray,
                                                  const PrimitiveHit& hole, const Meet& meet) {
  if constexpr (requires { shape.triangles(); })
    if (shape.triangles() != nullptr) return std::nullopt;  // a line meets a triangle once
  Ray rest = shape.surface_point(primitive, hole.uv).spawn(ray.direction);
  const DoubleVec3 gone = difference(rest.origin, ray.origin), d = widen(ray.direction);
  const auto start = static_cast<float>(dot(gone, d) / dot(d, d));
  rest.t_max = ray.t_max - start;
  const std::optional<PrimitiveHit> next = meet(rest);
  if (!next || !(start + next->t > hole.t && start + next->t < ray.t_max)) return std::nullopt;
  return PrimitiveHit{start + next->t, next->uv};
}

}  // namespace dspm
