// Directional albedos of GGX facets, as numbers for tables.
#pragma once

#include <cmath>

#include "dspm/base/math/vec.h"
#include "dspm/materials/brushed_albedo.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/microfacet.h"

namespace dspm {

/// Returns a direction in the plane y = 0.
inline Vec3 direction_of_cosine(float cos) { return {std::sqrt(std::max(0.f, 1 - cos * cos)), 0, cos}; }

/// A midpoint rule over facets.
struct FacetRule {
  int around, down;
  float share;  // of the way around: half, if the other half is its mirror image
};

/// Calls fn(facet normal, weight) for facets visible from o; they lie closer where they send light down.
template <class Fn>
void for_facets(const Ggx& facets, const Vec3& o, const FacetRule& rule, Fn&& fn) {
  for (int i = 0; i < rule.around; ++i)
    for (int j = 0; j < rule.down; ++j) {
      const float u = rule.share * (static_cast<float>(i) + 0.5f) / static_cast<float>(rule.around);
      const float w = 1 - (static_cast<float>(j) + 0.5f) / static_cast<float>(rule.down);
      fn(facets.sample_visible(o, u, 1 - w * w), 2 * w / static_cast<float>(rule.around * rule.down));
    }
}

/// Returns the mean of fn(facet normal), for equal alphas and o in the plane y = 0. It is off by less than 0.1% from
/// outside, and 1% from inside at alpha = 1.
template <class Fn>
float mean_over_facets(const Ggx& facets, const Vec3& o, Fn&& fn, const FacetRule& rule = {12, 32, 0.5f}) {
  double sum = 0;
  for_facets(facets, o, rule, [&](const Vec3& m, float weight) { sum += static_cast<double>(weight * fn(m)); });
  return static_cast<float>(sum);
}

/// Returns the share of light that facet m sends from o to where it escapes, if it reflects fresnel(cos) of it.
template <class Fresnel>
float reflected_by_facet(const Ggx& facets, const Vec3& o, const Vec3& m, Fresnel&& fresnel) {
  const Vec3 i = reflect(o, m);
  return i.z > 0 ? fresnel(dot(o, m)) * facets.visible_after(o, i) : 0.f;
}
inline float refracted_by_facet(const Ggx& facets, const Vec3& o, const Vec3& m, float eta) {
  const auto i = refract(o, m, eta);
  return i && i->z < 0 ? (1 - fresnel_dielectric(dot(o, m), eta)) * facets.visible_after(o, *i) : 0.f;
}

/// Returns the table of what facets do: of_facet(facets, o, m) is the share of light that facet m sends anywhere.
template <class Fn>
BrushedAlbedo brushed_mean(const Fn& of_facet) {
  return BrushedAlbedo([&](const Vec3& o, const Ggx& facets) {
    return mean_over_facets(facets, o, [&](const Vec3& m) { return of_facet(facets, o, m); }, {12, 20, 1});
  });
}

/// Returns the share of light that facets reflect and that then escapes, if a facet reflects fresnel(cos) of it.
template <class Fresnel>
float reflected_by_facets(float cos, float alpha, Fresnel&& fresnel) {
  const Vec3 o = direction_of_cosine(cos);
  const Ggx facets({alpha, alpha});
  return mean_over_facets(facets, o, [&](const Vec3& m) { return reflected_by_facet(facets, o, m, fresnel); });
}
inline float reflected_by_boundary(float cos, float alpha, float eta) {
  return reflected_by_facets(cos, alpha, [&](float c) { return fresnel_dielectric(c, eta); });
}

}  // namespace dspm
