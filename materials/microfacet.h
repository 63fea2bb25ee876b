// Rough surfaces as many small smooth facets: the anisotropic GGX distribution of facet normals with Smith's shadowing.
// Directions are in the shading frame, on the side of z > 0.
// [Trowbridge and Reitz 1975; Walter et al. 2007; Heitz 2014]
#pragma once

#include <algorithm>
#include <cmath>

#include "dspm/base/math/vec.h"

namespace dspm {

class Ggx {
 public:
  /// A surface counts as smooth if alpha is below this along both axes, as in pbrt; no axis is sharper than that.
  static constexpr float kSmoothest = 1e-3f;
  static bool is_smooth(Vec2 alpha) { return std::max(alpha.x, alpha.y) < kSmoothest; }

  explicit Ggx(Vec2 alpha) : alpha_x_(std::max(alpha.x, kSmoothest)), alpha_y_(std::max(alpha.y, kSmoothest)) {}

  float least_alpha() const { return std::min(alpha_x_, alpha_y_); }
  Vec2 alpha() const { return {alpha_x_, alpha_y_}; }

  /// D: area of facets with normal m, by solid angle and surface area.
  float density(const Vec3& m) const {
    if (m.z <= 0) return 0;
    const float x = m.x / alpha_x_, y = m.y / alpha_y_, r2 = x * x + y * y + m.z * m.z;
    return 1 / (kPi * alpha_x_ * alpha_y_ * r2 * r2);
  }
  /// Smith's Lambda: invisible over visible facet area, projected along w.
  float lambda(const Vec3& w) const {
    const float x = alpha_x_ * w.x, y = alpha_y_ * w.y;
    return 0.5f * (std::sqrt(1 + (x * x + y * y) / (w.z * w.z)) - 1);
  }
  /// G1: the fraction of facets visible from w.
  float visible(const Vec3& w) const { return 1 / (1 + lambda(w)); }
  /// G2: the fraction of facets visible from both, with correlated heights; the other direction may lie below,
  /// mirrored.
  float visible(const Vec3& wo, const Vec3& wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }
  /// The density of sample_visible() by the solid angle of m.
  float visible_density(const Vec3& wo, const Vec3& m) const {
    return visible(wo) * density(m) * std::max(0.f, dot(wo, m)) / wo.z;
  }
  /// f if the facets are perfect mirrors; m is halfway between wo and wi.
  float reflection(const Vec3& wo, const Vec3& wi, const Vec3& m) const {
    return density(m) * visible(wo, wi) / (4 * wo.z * wi.z);
  }
  /// The density by the solid angle of the direction to which a facet from sample_visible() reflects wo.
  float reflection_density(const Vec3& wo, const Vec3& m) const { return visible(wo) * density(m) / (4 * wo.z); }
  /// G2 / G1: the fraction of light from a facet visible from wo that escapes to wi.
  float visible_after(const Vec3& wo, const Vec3& wi) const {
    const float a = 1 + lambda(wo);
    return a / (a + lambda(wi));
  }
  /// The normal of a facet visible from wo. [Dupuy and Benyoub 2023, Sampling Visible GGX Normals with Spherical Caps]
  Vec3 sample_visible(const Vec3& wo, float u, float v) const;

 private:
  float alpha_x_, alpha_y_;
};

/// Converts perceived roughness to alpha, for pbrt's "remaproughness".
inline float roughness_to_alpha(float roughness) { return std::sqrt(std::max(0.f, roughness)); }

}  // namespace dspm
