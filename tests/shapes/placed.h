// Shapes at a place, and directions that leave a surface, for tests.
#pragma once

#include "dspm/shapes/placed_shape.h"
#include "tests/shapes/random.h"

namespace dspm::test {

inline PlacedShape placed(const Shape& shape, const Transform& to_world) {
  PlacedShape p;
  p.shape = &shape;
  p.to_world = to_world;
  p.to_world_is_identity = to_world.is_identity();
  return p;
}

/// To either side of the surface, half of them so flat that the cosine is between 1e-9 and 0.1.
inline Vec3 leaving(const Vec3& ng, Random& random) {
  const Basis basis = Basis::around(ng);
  const float phi = random.uniform(0, 2 * kPi);
  const float height = random.below(2) != 0 ? random.uniform() : random.magnitude(-9, -1);
  const float side = random.below(2) != 0 ? 1.f : -1.f;
  return normalize(basis.x * std::cos(phi) + basis.y * std::sin(phi) + basis.z * (height * side));
}

}  // namespace dspm::test
