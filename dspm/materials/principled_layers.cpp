#include "dspm/materials/principled_layers.h"

#include <algorithm>
#include <cmath>

#include "dspm/colour/rgb.h"
#include "dspm/materials/rough_boundary.h"
#include "dspm/math/vec.h"

namespace dspm {
namespace {

/// What leaves metal facets after two or more reflections, of white metal's share of it. [Kulla and Conty 2017; Hill
/// 2018]
Rgb after_more_reflections(const Rgb& mean_fresnel, float mean_albedo) {
  Rgb left;
  for (int c = 0; c < 3; ++c)
    left[c] = mean_fresnel[c] * mean_fresnel[c] * mean_albedo / (1 - mean_fresnel[c] * (1 - mean_albedo));
  return left;
}

}  // namespace

PrincipledLayers::PrincipledLayers(const Principled& at, const ShadingFrame& frame, float side)
    : tables_(*at.tables_),
      thin_(tables_.thin),
      outside_(thin_ || side > 0),
      up_(frame.local(frame.ng() * side, side)),
      coat_normal_(at.coat_ > 0 ? Vec3(at.coat_normal_) : Vec3{0, 0, 1}),
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
      diffuse_norm_(at.diffuse_norm_),
      under_film_(at.film_) {
  if (side < 0) coat_normal_ = {-coat_normal_.x, -coat_normal_.y, coat_normal_.z};
  if (under_film_ > 0) film_.emplace(tables_.film_eta, at.film_thickness_ * kMostFilmNm);
}

PrincipledLayers::Tilts PrincipledLayers::as_seen(const Vec3& camera) const {
  const Vec3 coat = coat_ > 0 ? lifted(coat_normal_, camera, up_) : coat_normal_;
  return {Tilt(lifted({0, 0, 1}, camera, up_)), Tilt(coat)};
}

PrincipledLayers::Cosines PrincipledLayers::cosines(const Vec3& w, const Tilts& tilts) {
  const float base = std::abs(w.z), coat = w.z < 0 ? -tilts.coat.cosine(w) : tilts.coat.cosine(w);
  return {base, coat > 0 ? std::min(base, coat) : base};
}

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

/// Of its brightest colour. Facets under a film mirror no more than what the tables know and the film's most gain.
float PrincipledLayers::mirrored_by_dielectric(float cos) const {
  if (smooth_) return specular_ * max_component(dielectric_facet(cos));
  const float bare = albedo(tables_.boundary->outside.reflected, cos);
  if (!film_) return specular_ * bare;
  return specular_ * std::min(1.f, bare + under_film_ * tables_.film_gain * albedo(tables_.common.metal, cos));
}
float PrincipledLayers::left_to_ground(const Cosines& w) const {
  return (1 - mirrored_by_dielectric(w.base)) * left_by_both(w);
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
  for (const Vec2& point : kRule) sum += point.y * 2 * point.x * left_to_ground({point.x, point.x});
  return sum;
}

/// Over all directions: of Schlick's term a 21st of the rest; a film's is taken at the mean cosine.
Rgb PrincipledLayers::mean_by_metal() const {
  const Rgb bare = base_ + (Rgb(1) - base_) / 21;
  return film_ ? bare + (film_->over_metal(base_, 2 / 3.f) - bare) * under_film_ : bare;
}

Rgb PrincipledLayers::metal_facet(float cos) const {
  const Rgb bare = fresnel_schlick(base_, cos);
  return film_ ? bare + (film_->over_metal(base_, cos) - bare) * under_film_ : bare;
}

Rgb PrincipledLayers::dielectric_facet(float cos) const {
  const Rgb bare(fresnel_dielectric(cos, tables_.eta));
  return film_ ? bare + (film_->over_dielectric(tables_.eta, cos) - bare) * under_film_ : bare;
}

/// From inside it mirrors what it mirrors of the light that comes the same way from outside.
Rgb PrincipledLayers::glass_facet(float cos) const {
  if (outside_ || !film_) return outside_ ? dielectric_facet(cos) : Rgb(fresnel_dielectric(cos, eta()));
  const float sin2_outside = (1 - cos * cos) / (eta() * eta());
  return sin2_outside >= 1 ? Rgb(1) : dielectric_facet(std::sqrt(1 - sin2_outside));
}

Rgb PrincipledLayers::mirrored_by_facet(float cos, const Cosines& o, const Cosines& i) const {
  Rgb sum;
  const float left = left_by_both(o, i);
  if (metal_ > 0) sum += metal_facet(cos) * (metal_ * left);
  if (opaque_ > 0) sum += fresnel_schlick(specular_colour_, cos) * dielectric_facet(cos) * (opaque_ * specular_ * left);
  if (glass_ > 0) sum += glass_facet(cos) * (glass_ * over_glass(o, i));
  return sum;
}

Rgb PrincipledLayers::through_facet(float cos_facet, const Cosines& o, const Cosines& i) const {
  const Rgb passes = (Rgb(1) - glass_facet(cos_facet)) * glass_;
  if (thin_) return base_ * passes * left_by_both(o, i);
  const Rgb tint(std::sqrt(base_.r), std::sqrt(base_.g), std::sqrt(base_.b));
  return tint * passes * left_by_both(outside_ ? o : i);
}

Rgb PrincipledLayers::through(const Vec3& o, const Vec3& i, const Tilts& tilts, Transport transport) const {
  const Cosines cos_o = cosines(o, tilts), cos_i = cosines(i, tilts);
  if (thin_) {
    const Vec3 mirrored = other_side(i), m = normalize(o + mirrored);
    return through_facet(dot(o, m), cos_o, cos_i) * facets_.reflection(o, mirrored, m);
  }
  const auto facet = facet_between(o, i, eta());
  if (!facet) return {};
  return through_facet(dot(o, facet->m), cos_o, cos_i) *
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

/// A film mirrors more or less of it than the tables know, which lose more of what is bent: the lesser, to gain nothing.
float PrincipledLayers::made_up_by_glass(float cos_o, float cos_i) const {
  const float known = made_up(all_by_facets(), cos_o, cos_i);
  return film_ ? std::min(known, made_up(tables_.common.metal, cos_o, cos_i)) : known;
}

/// For light that comes from one side and leaves on the same, or beyond.
Rgb PrincipledLayers::ground(const Cosines& o, const Cosines& i, bool beyond) const {
  if (!(opaque_ > 0) || !(diffuse_norm_ > 1e-6f)) return {};
  const Rgb colour = beyond ? beyond_colour_ * beyond_ : base_ * (1 - beyond_);
  return colour * (opaque_ / kPi * left_to_ground(o) * left_to_ground(i) / diffuse_norm_);
}

Rgb PrincipledLayers::diffuse(const Vec3& o, const Vec3& i, const Tilts& tilts) const {
  const Cosines cos_o = cosines(o, tilts), cos_i = cosines(i, tilts);
  Rgb sum = ground(cos_o, cos_i, false);
  if (metal_ > 0 && !smooth_) {
    const AlbedoTable& metal = tables_.common.metal;
    const float lost = metal_ * made_up(metal, o.z, i.z) * left_by_both(cos_o, cos_i);
    sum += after_more_reflections(mean_by_metal(), metal.mean(alpha_)) * lost;
  }
  if (glass_ > 0 && !smooth_) sum += Rgb(glass_ * made_up_by_glass(o.z, i.z) * over_glass(cos_o, cos_i));
  if (sheen_weight_ > 0) sum += sheen_ * (covered_ * Sheen(sheen_alpha_).f(o, i));
  return sum;
}

Rgb PrincipledLayers::f(const Vec3& o, const Vec3& i, Transport transport, LobeSet lobes) const {
  Rgb sum;
  if (i.z < 0) {
    const Tilts tilts = as_they_are();
    if ((lobes & Principled::kThrough) && !smooth_ && glass_ > 0) sum += through(o, i, tilts, transport);
    if ((lobes & Principled::kDiffuse) && beyond_ > 0) sum += ground(cosines(o, tilts), cosines(i, tilts), true);
    return sum;
  }
  const Tilts tilts = as_seen(transport == Transport::radiance ? o : i);
  if ((lobes & Principled::kSpecular) && !smooth_)
    if (const Tilt::Pair w = tilts.facets.pair(o, i, transport); w.above)
      sum += mirrored_by_facet(dot(w.o, w.m), cosines(o, tilts), cosines(i, tilts)) *
             (facets_.reflection(w.o, w.i, w.m) * w.factor);
  if ((lobes & Principled::kCoat) && !smooth_coat_ && coat_ > 0)
    if (const Tilt::Pair w = tilts.coat.pair(o, i, transport); w.above)
      sum += Rgb(covered_ * coat_ * std::min(left_by_sheen(o.z), left_by_sheen(i.z)) *
                 fresnel_dielectric(dot(w.o, w.m), kCoatEta) * coat_facets_.reflection(w.o, w.i, w.m) * w.factor);
  if (lobes & Principled::kDiffuse) sum += diffuse(o, i, tilts);
  return sum;
}

}  // namespace dspm
