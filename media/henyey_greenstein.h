// Scattering in a medium by the angle between old and new direction alone. [Henyey and Greenstein 1941]
#pragma once

#include <algorithm>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"

namespace dspm {

class HenyeyGreenstein {
 public:
  /// `g` is the mean cosine, between -1 and 1.
  constexpr explicit HenyeyGreenstein(float g) : g_(g) {}

  /// Returns the density by solid angle with which light that goes in direction w is scattered into direction wi. What
  /// arrives is scattered in some direction for certain, so this is the phase function, too.
  constexpr float pdf_w(const Vec3& w, const Vec3& wi) const {
    const float d = 1 + g_ * g_ - 2 * g_ * dot(w, wi);
    return (1 - g_ * g_) / (4 * kPi * d * rounded::sqrt(std::max(d, 1e-12f)));
  }
  /// Draws the direction into which light that goes in direction w is scattered.
  constexpr Vec3 sample(const Vec3& w, Vec2 u) const {
    float cosine = 1 - 2 * u.x;
    if (std::abs(g_) > 1e-3f) {
      const float s = (1 - g_ * g_) / (1 - g_ + 2 * g_ * u.x);
      cosine = std::clamp((1 + g_ * g_ - s * s) / (2 * g_), -1.f, 1.f);
    }
    return normalize(Basis::around(w).to_world(direction_at_height(cosine, 1 - cosine * cosine, u.y)));
  }

  friend constexpr bool operator==(const HenyeyGreenstein&, const HenyeyGreenstein&) = default;

 private:
  float g_;
};

}  // namespace dspm
