// Sheen: fibres that stand up from a surface and reflect light that grazes it, such as velvet's. The Charlie
// distribution of facet normals, D = (2 + 1/alpha) sin^(1/alpha) / (2 pi), with the shadowing that was fitted to it.
// [Estevez and Kulla 2017, Production Friendly Microfacet Sheen BRDF; glTF 2.0, KHR_materials_sheen]
#pragma once

#include <cmath>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/albedo_table.h"

namespace dspm {

class Sheen {
 public:
  /// With a smaller alpha, the fitted shadowing lets more light out at grazing angles than comes in.
  static constexpr float kLeastAlpha = 0.07f;

  explicit Sheen(float alpha) : alpha_(std::max(alpha, kLeastAlpha)) {}

  /// Returns f of white sheen, for directions in the shading frame, both above.
  float f(const Vec3& wo, const Vec3& wi) const {
    const Vec3 m = normalize(wo + wi);
    const float sine = std::sqrt(std::max(0.f, 1 - m.z * m.z));
    const float density = (2 + 1 / alpha_) * rounded::pow(sine, 1 / alpha_) / (2 * kPi);
    return density / ((1 + lambda(wo.z) + lambda(wi.z)) * 4 * wo.z * wi.z);
  }

 private:
  float lambda(float cos) const {
    return rounded::exp(cos < 0.5f ? exponent(cos) : 2 * exponent(0.5f) - exponent(1 - cos));
  }
  float exponent(float x) const {
    const float t = (1 - alpha_) * (1 - alpha_);
    const auto fitted = [&](float rough, float smooth) { return rough + t * (smooth - rough); };
    return fitted(21.5473f, 25.3245f) / (1 + fitted(3.82987f, 3.32435f) * rounded::pow(x, fitted(0.19823f, 0.16801f))) +
           fitted(-1.97760f, -1.27393f) * x + fitted(-4.32054f, -4.85967f);
  }

  float alpha_;
};

}  // namespace dspm
