// Rough surfaces as many small smooth facets: the anisotropic GGX distribution of facet normals with Smith's shadowing.
// Directions are in the shading frame, on the side of z > 0.
// [Trowbridge and Reitz 1975; Walter et al. 2007; Heitz 2014]
#pragma once

#include <algorithm>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"

namespace dspm {

class Ggx {
 public:
  /// A surface counts as smooth if alpha is below this along both axes, as in pbrt; no axis is sharper than that.
  static constexpr float kSmoothest = 1e-3f;
  static constexpr bool is_smooth(Vec2 alpha) { return std::max(alpha.x, alpha.y) < kSmoothest; }

  constexpr explicit Ggx(Vec2 alpha) : alpha_x_(of_axis(alpha.x)), alpha_y_(of_axis(alpha.y)) {}

  constexpr float least_alpha() const { return std::min(alpha_x_, alpha_y_); }
  constexpr Vec2 alpha() const { return {alpha_x_, alpha_y_}; }

  /// D: area of facets with normal m, by solid angle and surface area.
  constexpr float density(const Vec3& m) const {
    if (m.z <= 0) return 0;
    const float x = m.x / alpha_x_, y = m.y / alpha_y_, r2 = x * x + y * y + m.z * m.z;
    return 1 / (kPi * alpha_x_ * alpha_y_ * r2 * r2);
  }
  /// Smith's Lambda: invisible over visible facet area, projected along w.
  constexpr float lambda(const Vec3& w) const {
    const float x = alpha_x_ * w.x, y = alpha_y_ * w.y;
    return 0.5f * (rounded::sqrt(1 + (x * x + y * y) / (w.z * w.z)) - 1);
  }
  /// G1: the fraction of facets visible from w.
  constexpr float visible(const Vec3& w) const { return 1 / (1 + lambda(w)); }
  /// G2: the fraction of facets visible from both, with correlated heights; the other direction may lie below,
  /// mirrored.
  constexpr float visible(const Vec3& wo, const Vec3& wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }
  /// The density of sample_visible() by the solid angle of m.
  constexpr float visible_density(const Vec3& wo, const Vec3& m) const {
    return visible(wo) * density(m) * std::max(0.f, dot(wo, m)) / wo.z;
  }
  /// f if the facets are perfect mirrors; m is halfway between wo and wi.
  constexpr float reflection(const Vec3& wo, const Vec3& wi, const Vec3& m) const {
    return density(m) * visible(wo, wi) / (4 * wo.z * wi.z);
  }
  /// The density by the solid angle of the direction to which a facet from sample_visible() reflects wo.
  constexpr float reflection_density(const Vec3& wo, const Vec3& m) const {
    return visible(wo) * density(m) / (4 * wo.z);
  }
  /// G2 / G1: the fraction of light from a facet visible from wo that escapes to wi.
  constexpr float visible_after(const Vec3& wo, const Vec3& wi) const {
    const float a = 1 + lambda(wo);
    return a / (a + lambda(wi));
  }
  /// The normal of a facet visible from wo. [Dupuy and Benyoub 2023, Sampling Visible GGX Normals with Spherical Caps]
  /// Stretched to alpha = 1 the facets form a hemisphere, whose mirrored directions fill a spherical cap; its points are
  /// uniform.
  constexpr Vec3 sample_visible(const Vec3& wo, float u, float v) const {
    const Vec3 stretched = normalize({alpha_x_ * wo.x, alpha_y_ * wo.y, wo.z});
    const float z = (1 - v) * (1 + stretched.z) - stretched.z, radius = rounded::sqrt(std::max(0.f, 1 - z * z));
    const rounded::SinCos phi = rounded::sin_cos(2 * kPi * u);
    const Vec3 halfway = stretched + Vec3{radius * phi.cos, radius * phi.sin, z};
    return normalize({alpha_x_ * halfway.x, alpha_y_ * halfway.y, std::max(halfway.z, 1e-9f)});
  }

 private:
  /// As std::max(), but by value: on a device, kSmoothest has no address.
  static constexpr float of_axis(float alpha) { return alpha < kSmoothest ? kSmoothest : alpha; }

  float alpha_x_, alpha_y_;
};

/// Converts perceived roughness to alpha, for pbrt's "remaproughness".
constexpr float roughness_to_alpha(float roughness) { return rounded::sqrt(std::max(0.f, roughness)); }

/// A metal's complex index of refraction, eta + ik.
struct MetalIndex {
  Spectrum eta, k;
};

}  // namespace dspm
