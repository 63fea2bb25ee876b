// The primitives of a shape that emits light, as a point sees them: those that send more light there are chosen more
// often, and where it pays, points are uniform by solid angle.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "dspm/base/math/vec.h"
#include "dspm/lights/light_tree.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

class EmitterSight {
 public:
  /// `powers`, by primitive, may be in any unit. `placed` must outlive this.
  EmitterSight(const PlacedShape& placed, std::span<const float> powers, bool two_sided);

  struct Choice {
    int primitive;
    float probability;
    float rest;  // uniform again in [0, 1)
  };
  /// Nearby numbers choose nearby primitives.
  Choice choose(const Vec3& from, float u) const;
  float probability(const Vec3& from, int primitive) const;

  struct Point {
    SurfacePoint point;
    float pdf_w;
  };
  /// Returns a point that is uniform by solid angle; nullopt if that is not worth while, or not known.
  std::optional<Point> sample(const Vec3& from, int primitive, Vec2 u) const;
  /// Returns the density of sample() by solid angle; nullopt as there.
  std::optional<float> pdf_w(const Vec3& from, int primitive) const;

 private:
  struct Pair {
    double first, second;
  };
  std::array<Vec3, 3> corners(int primitive) const;
  /// Returns how often each of two primitives is chosen.
  Pair chances_of_two(const Vec3& from) const;
  /// Returns 1 - cos of half the angle that the sphere fills; nullopt from inside, or if it is no sphere.
  std::optional<float> cone(const Vec3& from) const;

  const PlacedShape& placed_;
  float radius_ = 0;  // of a whole sphere, in the world; 0: it is something else
  Vec3 center_;
  std::array<float, 2> of_two_ = {1, 0};  // the powers of one or two primitives
  LightTree tree_;                        // of more
};

/// Returns the bounds of the light that leaves the primitives.
LightBounds bounds_of_emitter(const PlacedShape& placed, bool two_sided);

}  // namespace dspm
