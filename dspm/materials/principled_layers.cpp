#include "dspm/materials/principled_layers.h"

#include <algorithm>
#include <cmath>

#include "dspm/colour/rgb.h"
#include "dspm/materials/rough_boundary.h"
#include "dspm/math/vec.h"

namespace dspm {
namespace {

/// [Schlick 1994]
Rgb fresnel_schlick(const Rgb& straight, float cos) {
  const float c = 1 - cos, c2 = c * c;
  return straight + (Rgb(1) - straight) * (c2 * c2 * c);
}

/// What leaves metal facets after two or more reflections, of white metal's share of it. [Kulla and Conty 2017; Hill
/// 2018]
Rgb after_more_reflections(const Rgb& straight, float mean_albedo) {
  Rgb left;
  for (int c = 0; c < 3; ++c) {
    const float mean_fresnel = straight[c] + (1 - straight[c]) / 21;
    left[c] = mean_fresnel * mean_fresnel * mean_albedo / (1 - mean_fresnel * (1 - mean_albedo));
  }
  return left;
}

}  // namespace

PrincipledLayers::PrincipledLayers(const Principled& at, float side)
    : tables_(*at.tables_),
      thin_(tables_.thin),
      outside_(thin_ || side > 0),
      base_(at.base_),
      sheen_(at.sheen_),
      specular_colour_(at.specular_colour_),
      beyond_colour_(at.beyond_colour_),
      metal_(at.metallic_),
      glass_((1 - metal_) * at.transmission_),
      opaque_((1 - metal_) * (1 - at.transmission_)),
      beyond_(at.beyond_),
      specular_(at.specular_),
      coat_(at.coat_),
      covered_(outside_ ? 1 : 1 - glass_),
      facets_({at.alpha_x_, at.alpha_y_}),
      coat_facets_({at.coat_alpha_, at.coat_alpha_}),
      smooth_(Ggx::is_smooth({at.alpha_x_, at.alpha_y_})),
      smooth_coat_(Ggx::is_smooth({at.coat_alpha_, at.coat_alpha_})),
      is_isotropic_(facets_.alpha().x == facets_.alpha().y),
      alpha_((facets_.alpha().x + facets_.alpha().y) / 2),
      coat_alpha_(at.coat_alpha_),
      sheen_alpha_(at.sheen_alpha_),
      sheen_weight_(max_component(sheen_)),
      diffuse_norm_(at.diffuse_norm_) {}

bool PrincipledLayers::only_diffuse() const { return opaque_ == 1 && sheen_weight_ == 0 && beyond_ == 0; }

LobeSet PrincipledLayers::lobes(float least_alpha) const {
  const auto if_rough = [&](LobeSet lobe, bool smooth, const Ggx& facets) {
    return (smooth ? 0 : facets.least_alpha()) >= std::max(least_alpha, 0.f) ? lobe : LobeSet{0};
  };
  LobeSet all = 0;
  if (metal_ > 0 || glass_ > 0 || opaque_ * specular_ > 0) all |= if_rough(Principled::kSpecular, smooth_, facets_);
  if (glass_ > 0) all |= if_rough(Principled::kThrough, smooth_, facets_);
  if (coat_ > 0) all |= if_rough(Principled::kCoat, smooth_coat_, coat_facets_);
  const bool makes_up = !smooth_ && (metal_ > 0 || glass_ > 0);
  if (opaque_ > 0 || sheen_weight_ > 0 || makes_up) all |= Principled::kDiffuse;
  return all;
}

/// Of facets of two alphas: that of their mean, or at grazing angles, where it is not between the two, the greatest, so
/// that nothing is gained.
float PrincipledLayers::albedo(const AlbedoTable& table, float cos) const {
  constexpr float kGrazing = 0.4f;
  const float mean = table.of(cos, alpha_);
  if (is_isotropic_ || cos >= kGrazing) return mean;
  const float most = std::max({mean, table.of(cos, facets_.alpha().x), table.of(cos, facets_.alpha().y)});
  return most + cos / kGrazing * (mean - most);
}

float PrincipledLayers::left_by_sheen(float cos) const {
  return sheen_weight_ > 0 ? 1 - sheen_weight_ * tables_.common.sheen.of(cos, sheen_alpha_) : 1;
}
float PrincipledLayers::mirrored_by_coat(float cos) const {
  if (coat_ == 0) return 0;
  return coat_ * (smooth_coat_ ? fresnel_dielectric(cos, kCoatEta) : tables_.common.coat.of(cos, coat_alpha_));
}
float PrincipledLayers::left_by_coat(float cos) const { return 1 - mirrored_by_coat(cos); }

float PrincipledLayers::mirrored_by_dielectric(float cos) const {
  return specular_ *
         (smooth_ ? fresnel_dielectric(cos, tables_.eta) : albedo(tables_.boundary->outside.reflected, cos));
}
float PrincipledLayers::left_to_ground(float cos) const {
  return (1 - mirrored_by_dielectric(cos)) * left_by_both(cos);
}

float PrincipledLayers::diffuse_norm() const {
  // Gauss and Legendre's rule of eight points on [0, 1].
  constexpr std::array<Vec2, 8> kRule{{{0.0198550718f, 0.0506142681f},
                                       {0.1016667613f, 0.1111905172f},
                                       {0.2372337950f, 0.1568533229f},
                                       {0.4082826788f, 0.1813418917f},
                                       {0.5917173212f, 0.1813418917f},
                                       {0.7627662050f, 0.1568533229f},
                                       {0.8983332387f, 0.1111905172f},
                                       {0.9801449282f, 0.0506142681f}}};
  if (opaque_ == 0) return 1;
  float sum = 0;
  for (const Vec2& point : kRule) sum += point.y * 2 * point.x * left_to_ground(point.x);
  return sum;
}

Rgb PrincipledLayers::mirrored_by_facet(float cos, float cos_o, float cos_i) const {
  Rgb sum;
  const float left = left_by_both(cos_o, cos_i);
  if (metal_ > 0) sum += fresnel_schlick(base_, cos) * (metal_ * left);
  if (opaque_ > 0)
    sum += fresnel_schlick(specular_colour_, cos) * (opaque_ * specular_ * left * fresnel_dielectric(cos, tables_.eta));
  if (glass_ > 0) sum += Rgb(glass_ * over_glass(cos_o, cos_i) * fresnel_dielectric(cos, eta()));
  return sum;
}

Rgb PrincipledLayers::through_facet(float cos_facet, float cos_o, float cos_i) const {
  const float passes = glass_ * (1 - fresnel_dielectric(cos_facet, eta()));
  if (thin_) return base_ * (passes * left_by_both(cos_o, std::abs(cos_i)));
  const Rgb tint(std::sqrt(base_.r), std::sqrt(base_.g), std::sqrt(base_.b));
  return tint * (passes * left_by_both(outside_ ? cos_o : std::abs(cos_i)));
}

Rgb PrincipledLayers::through(const Vec3& o, const Vec3& i, Transport transport) const {
  if (thin_) {
    const Vec3 mirrored = other_side(i), m = normalize(o + mirrored);
    return through_facet(dot(o, m), o.z, i.z) * facets_.reflection(o, mirrored, m);
  }
  const auto facet = facet_between(o, i, eta());
  if (!facet) return {};
  return through_facet(dot(o, facet->m), o.z, i.z) *
         (refraction(facets_, o, i, *facet) * transport_scale(transport, eta()));
}

float PrincipledLayers::density_through(const Vec3& o, const Vec3& i) const {
  if (thin_) return facets_.reflection_density(o, normalize(o + other_side(i)));
  const auto facet = facet_between(o, i, eta());
  return facet ? refraction_density(facets_, o, *facet) : 0;
}

/// The diffuse lobe that makes up for what a lobe of this albedo loses.
float PrincipledLayers::made_up(const AlbedoTable& table, float cos_o, float cos_i) const {
  const float lost = 1 - table.mean(alpha_);
  if (lost < 1e-5f) return 0;
  // Facets of two alphas lose less than their mean along the one and more along the other: less, to gain nothing.
  const Vec2 alpha = facets_.alpha();
  const float sure = 0.9f + 0.1f * std::min(alpha.x, alpha.y) / std::max(alpha.x, alpha.y);
  return sure * (1 - albedo(table, cos_o)) * (1 - albedo(table, cos_i)) / (kPi * lost);
}

/// For light that comes from one side and leaves on the same, or on the other.
Rgb PrincipledLayers::ground(float cos_o, float cos_i) const {
  if (!(opaque_ > 0) || !(diffuse_norm_ > 1e-6f)) return {};
  const Rgb colour = cos_i > 0 ? base_ * (1 - beyond_) : beyond_colour_ * beyond_;
  return colour * (opaque_ / kPi * left_to_ground(cos_o) * left_to_ground(std::abs(cos_i)) / diffuse_norm_);
}

Rgb PrincipledLayers::diffuse(const Vec3& o, const Vec3& i) const {
  Rgb sum = ground(o.z, i.z);
  if (metal_ > 0 && !smooth_) {
    const AlbedoTable& metal = tables_.common.metal;
    const float lost = metal_ * made_up(metal, o.z, i.z) * left_by_both(o.z, i.z);
    sum += after_more_reflections(base_, metal.mean(alpha_)) * lost;
  }
  if (glass_ > 0 && !smooth_) sum += Rgb(glass_ * made_up(all_by_facets(), o.z, i.z) * over_glass(o.z, i.z));
  if (sheen_weight_ > 0) sum += sheen_ * (covered_ * Sheen(sheen_alpha_).f(o, i));
  return sum;
}

Rgb PrincipledLayers::f(const Vec3& o, const Vec3& i, Transport transport, LobeSet lobes) const {
  Rgb sum;
  if (i.z < 0) {
    if ((lobes & Principled::kThrough) && !smooth_ && glass_ > 0) sum += through(o, i, transport);
    if ((lobes & Principled::kDiffuse) && beyond_ > 0) sum += ground(o.z, i.z);
    return sum;
  }
  const Vec3 m = normalize(o + i);
  const float cos = dot(o, m);
  if ((lobes & Principled::kSpecular) && !smooth_)
    sum += mirrored_by_facet(cos, o.z, i.z) * facets_.reflection(o, i, m);
  if ((lobes & Principled::kCoat) && !smooth_coat_ && coat_ > 0)
    sum += Rgb(covered_ * coat_ * std::min(left_by_sheen(o.z), left_by_sheen(i.z)) * fresnel_dielectric(cos, kCoatEta) *
               coat_facets_.reflection(o, i, m));
  if (lobes & Principled::kDiffuse) sum += diffuse(o, i);
  return sum;
}

}  // namespace dspm
