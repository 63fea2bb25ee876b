// Scattering in a medium by the angle between old and new direction alone. [Henyey and Greenstein 1941]
#pragma once

#include "dspm/base/math/vec.h"

namespace dspm {

class HenyeyGreenstein {
 public:
  /// `g` is the mean cosine, between -1 and 1.
  explicit HenyeyGreenstein(float g) : g_(g) {}

  /// Returns the density by solid angle with which light that goes in direction w is scattered into direction wi. What
  /// arrives is scattered in some direction for certain, so this is the phase function, too.
  float pdf_w(const Vec3& w, const Vec3& wi) const;
  /// Draws the direction into which light that goes in direction w is scattered.
  Vec3 sample(const Vec3& w, Vec2 u) const;

  friend bool operator==(const HenyeyGreenstein&, const HenyeyGreenstein&) = default;

 private:
  float g_;
};

}  // namespace dspm
