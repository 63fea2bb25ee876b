#include "dspm/materials/principled_layers.h"

#include <algorithm>
#include <cmath>

#include "dspm/colour/rgb.h"
#include "dspm/materials/rough_boundary.h"
#include "dspm/math/sampling.h"
#include "dspm/math/vec.h"

namespace dspm {
namespace {

/// A dark base must not take all paths from what mirrors. In steps, so that finishes that are about equally bright
/// choose alike and stay one path.
float weight_in_choice(float brightness) {
  return brightness >= 1 / 4.f ? 1 : brightness >= 1 / 16.f ? 1 / 4.f : 1 / 16.f;
}

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
      outside_(side > 0),
      base_(at.base_),
      sheen_(at.sheen_),
      metal_(at.metallic_),
      glass_((1 - metal_) * at.transmission_),
      opaque_((1 - metal_) * (1 - at.transmission_)),
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

bool PrincipledLayers::only_diffuse() const { return opaque_ == 1 && sheen_weight_ == 0; }

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
  if (opaque_ > 0) sum += Rgb(opaque_ * specular_ * left * fresnel_dielectric(cos, tables_.eta));
  if (glass_ > 0) sum += Rgb(glass_ * over_glass(cos_o, cos_i) * fresnel_dielectric(cos, eta()));
  return sum;
}

Rgb PrincipledLayers::through_facet(float cos_facet, float cos_o, float cos_i) const {
  const Rgb tint(std::sqrt(base_.r), std::sqrt(base_.g), std::sqrt(base_.b));
  const float left = left_by_both(outside_ ? cos_o : std::abs(cos_i));
  return tint * (glass_ * left * (1 - fresnel_dielectric(cos_facet, eta())));
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

Rgb PrincipledLayers::diffuse(const Vec3& o, const Vec3& i) const {
  Rgb sum;
  if (opaque_ > 0 && diffuse_norm_ > 1e-6f)
    sum += base_ * (opaque_ / kPi * left_to_ground(o.z) * left_to_ground(i.z) / diffuse_norm_);
  if (metal_ > 0 && !smooth_) {
    const AlbedoTable& metal = tables_.common.metal;
    const float lost = metal_ * made_up(metal, o.z, i.z) * left_by_both(o.z, i.z);
    sum += after_more_reflections(base_, metal.mean(alpha_)) * lost;
  }
  if (glass_ > 0 && !smooth_)
    sum += Rgb(glass_ * made_up(boundary().reflected_or_refracted, o.z, i.z) * over_glass(o.z, i.z));
  if (sheen_weight_ > 0) sum += sheen_ * (covered_ * Sheen(sheen_alpha_).f(o, i));
  return sum;
}

Rgb PrincipledLayers::f(const Vec3& o, const Vec3& i, Transport transport, LobeSet lobes) const {
  Rgb sum;
  if (i.z < 0) {
    if (!(lobes & Principled::kThrough) || smooth_ || glass_ == 0) return sum;
    const auto facet = facet_between(o, i, eta());
    if (!facet) return sum;
    return through_facet(dot(o, facet->m), o.z, i.z) *
           (refraction(facets_, o, i, *facet) * transport_scale(transport, eta()));
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

/// Colours count in steps or not at all: frames of different colours then choose alike.
std::array<float, 4> PrincipledLayers::weights(float cos_o) const {
  const float left = left_by_both(cos_o), over_glass = outside_ ? left : 1;
  const float metal = metal_ == 0 || smooth_ ? 1 : albedo(tables_.common.metal, cos_o);
  const float dielectric = mirrored_by_dielectric(cos_o);
  float glass_mirrored = 0, glass = 1;
  if (glass_ > 0 && smooth_) glass_mirrored = fresnel_dielectric(cos_o, eta());
  if (glass_ > 0 && !smooth_) {
    glass = albedo(boundary().reflected_or_refracted, cos_o);
    glass_mirrored = std::min(glass, albedo(boundary().reflected, cos_o));
  }
  const float ground = opaque_ * (1 - dielectric) * left * weight_in_choice(max_component(base_));
  const float made_up = metal_ * (1 - metal) * left + glass_ * (1 - glass) * over_glass;
  const float of_sheen = sheen_weight_ > 0 ? covered_ * (1 - left_by_sheen(cos_o)) : 0;
  return {(metal_ * metal + opaque_ * dielectric) * left + glass_ * glass_mirrored * over_glass,
          glass_ * (glass - glass_mirrored) * over_glass, ground + made_up + of_sheen,
          covered_ * mirrored_by_coat(cos_o) * left_by_sheen(cos_o)};
}

PrincipledChances PrincipledLayers::chances(float cos_o, LobeSet lobes) const {
  constexpr float kLeast = 1e-4f;  // no lobe that exists is left out where the tables round it to nothing
  const LobeSet known = lobes & this->lobes(0);
  PrincipledChances chances{weights(cos_o)};
  float sum = 0;
  for (int lobe = 0; lobe < 4; ++lobe) {
    float& chance = chances.chance[static_cast<std::size_t>(lobe)];
    chance = known >> lobe & 1 ? std::max(chance, kLeast) : 0;
    sum += chance;
  }
  for (float& chance : chances.chance) chance = sum > 0 ? chance / sum : 0;
  return chances;
}

float PrincipledLayers::density(const Vec3& o, const Vec3& i, const PrincipledChances& chances) const {
  if (i.z < 0) {
    if (smooth_ || chances[1] == 0) return 0;
    const auto facet = facet_between(o, i, eta());
    return facet ? chances[1] * refraction_density(facets_, o, *facet) : 0;
  }
  const Vec3 m = normalize(o + i);
  float sum = chances[2] * i.z / kPi;
  if (!smooth_ && chances[0] > 0) sum += chances[0] * facets_.reflection_density(o, m);
  if (!smooth_coat_ && chances[3] > 0) sum += chances[3] * coat_facets_.reflection_density(o, m);
  return sum;
}

std::optional<PrincipledLayers::Drawn> PrincipledLayers::draw(const Vec3& o, const Vec3& u,
                                                              const PrincipledChances& chances) const {
  // Reflections first: then coupled frames whose lobes differ part as little as possible.
  float below = chances[3];
  if (u.z < below) return draw_coat(o, u, chances[3]);
  below += chances[0];
  if (u.z < below) return draw_specular(o, u, chances[0]);
  below += chances[1];
  if (u.z < below) return draw_through(o, u, chances[1]);
  if (chances[2] == 0) return std::nullopt;
  const Vec3 i = cosine_hemisphere({u.x, u.y});
  return i.z > 0 ? std::optional(Drawn{i, false}) : std::nullopt;
}

std::optional<PrincipledLayers::Drawn> PrincipledLayers::draw_coat(const Vec3& o, const Vec3& u, float chance) const {
  if (smooth_coat_)
    return Drawn{{-o.x, -o.y, o.z},
                 true,
                 Rgb(covered_ * left_by_sheen(o.z) * coat_ * fresnel_dielectric(o.z, kCoatEta) / chance)};
  const Vec3 i = reflect(o, coat_facets_.sample_visible(o, u.x, u.y));
  return i.z > 0 ? std::optional(Drawn{i, false}) : std::nullopt;
}

std::optional<PrincipledLayers::Drawn> PrincipledLayers::draw_specular(const Vec3& o, const Vec3& u,
                                                                       float chance) const {
  if (smooth_) return Drawn{{-o.x, -o.y, o.z}, true, mirrored_by_facet(o.z, o.z, o.z) / chance};
  const Vec3 i = reflect(o, facets_.sample_visible(o, u.x, u.y));
  return i.z > 0 ? std::optional(Drawn{i, false}) : std::nullopt;
}

std::optional<PrincipledLayers::Drawn> PrincipledLayers::draw_through(const Vec3& o, const Vec3& u,
                                                                      float chance) const {
  const Vec3 m = smooth_ ? Vec3{0, 0, 1} : facets_.sample_visible(o, u.x, u.y);
  const auto i = refract(o, m, eta());
  if (!i || i->z >= 0) return std::nullopt;
  if (smooth_) return Drawn{*i, true, through_facet(o.z, o.z, i->z) / chance};
  return Drawn{*i, false};
}

}  // namespace dspm
