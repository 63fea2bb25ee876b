// Cases for tests of materials: surfaces to put them on, directions, subsets of lobes.
#pragma once

#include <cmath>
#include <vector>

#include "dspm/base/math/rng.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/bsdf.h"
#include "dspm/shapes/shape.h"

namespace dspm::test {

/// A surface whose normals are z, unless shading bends them, met by light of 450 nm.
inline SurfacePoint surface(Vec3 ns = {0, 0, 1}, Vec3 dpdu = {1, 0, 0}) {
  SurfacePoint point{{{}, {}, {0, 0, 1}, normalize(ns), dpdu, {0.3f, 0.6f}}};
  point.wavelength.nm = 450;
  return point;
}
inline SurfacePoint bent_surface() { return surface({0.35f, -0.2f, 1}, {2, 1, 0}); }

inline Vec3 direction(float cos, float phi) {
  const float sin = std::sqrt(std::max(0.f, 1 - cos * cos));
  return {sin * rounded::cos(phi), sin * rounded::sin(phi), cos};
}
/// Directions from straight on to grazing.
inline std::vector<Vec3> directions_above() {
  return {direction(1, 0), direction(0.9f, 1), direction(0.6f, 2.5f), direction(0.3f, 4), direction(0.03f, 5.5f)};
}
inline std::vector<Vec3> directions() {
  std::vector<Vec3> both = directions_above();
  for (const Vec3& w : directions_above()) both.push_back({w.x, w.y, -w.z});
  return both;
}

inline std::vector<LobeSet> subsets_of(LobeSet lobes) {
  std::vector<LobeSet> subsets;
  for (int subset = 1; subset <= lobes; ++subset)
    if ((subset & lobes) == subset) subsets.push_back(static_cast<LobeSet>(subset));
  return subsets;
}

inline Vec3 three_numbers(const PathRandom& random, int n) {
  const Vec2 pair = random.pair(n, 0);
  return {pair.x, pair.y, random.number(n, 2)};
}
/// A direction distributed uniformly over the sphere.
inline Vec3 any_direction(const PathRandom& random, int n) {
  const Vec2 u = random.pair(n, 4);
  return direction(2 * u.x - 1, 2 * kPi * u.y);
}

}  // namespace dspm::test
