#include "dspm/media/henyey_greenstein.h"

#include <algorithm>
#include <cmath>

namespace dspm {

float HenyeyGreenstein::pdf_w(const Vec3& w, const Vec3& wi) const {
  const float d = 1 + g_ * g_ - 2 * g_ * dot(w, wi);
  return (1 - g_ * g_) / (4 * kPi * d * std::sqrt(std::max(d, 1e-12f)));
}

Vec3 HenyeyGreenstein::sample(const Vec3& w, Vec2 u) const {
  float cosine = 1 - 2 * u.x;
  if (std::abs(g_) > 1e-3f) {
    const float s = (1 - g_ * g_) / (1 - g_ + 2 * g_ * u.x);
    cosine = std::clamp((1 + g_ * g_ - s * s) / (2 * g_), -1.f, 1.f);
  }
  const float sine = std::sqrt(1 - cosine * cosine), phi = 2 * kPi * u.y;
  return normalize(Basis::around(w).to_world({sine * std::cos(phi), sine * std::sin(phi), cosine}));
}

}  // namespace dspm
