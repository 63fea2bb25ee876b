// The sphere around everything, from which lights infinitely far away send their photons.
#pragma once

#include <algorithm>

#include "dspm/base/math/vec.h"

namespace dspm {

struct BoundingSphere {
  Vec3 center;
  float radius = 1;  // of an empty scene
};

/// Returns a sphere around the box's corners; the radius is never 0.
inline BoundingSphere sphere_around(const Bounds3& bounds) {
  if (bounds.empty()) return {};
  const Vec3 center = bounds.center();
  return {center, std::max(0.5f * length(bounds.extent()), 1e-6f * (1 + length(center)))};
}

/// Returns whether the box lies in the sphere, up to rounding.
inline bool is_within(const Bounds3& box, const BoundingSphere& sphere) {
  constexpr float kLeeway = 1e-5f;
  const Vec3 far = max(abs(box.low - sphere.center), abs(box.high - sphere.center));
  return box.empty() || length(far) <= sphere.radius * (1 + kLeeway);
}

}  // namespace dspm
