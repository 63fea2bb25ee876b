#include "dspm/materials/principled/principled_layers.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/rough_boundary.h"

namespace dspm {
namespace {

/// Returns the share of what a boundary of that index lets through straight on that is mirrored as well; below 0 if
/// less is mirrored.
Spectrum more_than_usual(const Spectrum& straight, float eta) {
  constexpr float kRounding = 1e-5f;  // of a SmallNumber
  const float usual = fresnel_dielectric(1, eta);
  Spectrum more = (straight - Spectrum(usual)) / (1 - usual);
  for (int c = 0; c < 3; ++c)
    if (std::abs(more[c]) < kRounding) more[c] = 0;
  return more;
}

}  // namespace

PrincipledLayers::PrincipledLayers(const Principled& at, const ShadingFrame& frame, float side)
    : tables_(*at.tables_),
      eta_(at.eta_),
      mirroring_eta_(at.refraction().mirrors_by_wavelength(side) ? eta_ : tables_.eta),
      thin_(tables_.thin),
      outside_(thin_ || side > 0),
      up_(frame.local(frame.ng() * side, side)),
      coat_normal_(at.coat_ > 0 ? Vec3(at.coat_normal_) : Vec3{0, 0, 1}),
      base_(at.base_),
      sheen_(at.sheen_),
      beyond_colour_(at.beyond_colour_),
      more_(more_than_usual(at.straight_, tables_.eta)),
      most_more_(max_component(more_)),
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
      narrowness_(is_isotropic_ ? 0 : 1 - facets_.alpha().y / facets_.alpha().x),
      sheen_weight_(max_component(sheen_)),
      diffuse_norm_(at.diffuse_norm_),
      under_film_(at.film_) {
  if (side < 0) coat_normal_ = {-coat_normal_.x, -coat_normal_.y, coat_normal_.z};
  if (under_film_ > 0) film_.emplace(tables_.film_eta, at.film_thickness_ * kMostFilmNm, *at.palette_);
}

PrincipledLayers::Tilts PrincipledLayers::as_seen(const Vec3& camera) const {
  const Vec3 coat = coat_ > 0 ? lifted(coat_normal_, camera, up_) : coat_normal_;
  return {Tilt(lifted({0, 0, 1}, camera, up_)), Tilt(coat)};
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

/// Returns the mean over all directions: of Schlick's term a 21st of the rest; a film's is taken at the mean cosine.
Spectrum PrincipledLayers::mean_by_metal() const {
  const Spectrum bare = base_ + (Spectrum(1) - base_) / 21;
  return film_ ? bare + (film_->over_metal(base_, 2 / 3.f) - bare) * under_film_ : bare;
}

Spectrum PrincipledLayers::metal_facet(float cos) const {
  const Spectrum bare = fresnel_schlick(base_, cos);
  return film_ ? bare + (film_->over_metal(base_, cos) - bare) * under_film_ : bare;
}

/// Here and below, `eta` is inside over outside.
Spectrum PrincipledLayers::dielectric_facet(float cos, float eta) const {
  const Spectrum bare(fresnel_dielectric(cos, eta));
  return film_ ? bare + (film_->over_dielectric(eta, cos) - bare) * under_film_ : bare;
}

/// Returns a facet's reflectance. With Schlick's term s, the boundary mirrors F0 + (1 - F0) s, and this F0' + (1 - F0')
/// s. [glTF 2.0, KHR_materials_specular]
Spectrum PrincipledLayers::opaque_facet(float cos) const {
  const Spectrum bare = dielectric_facet(cos, tables_.eta);
  Spectrum facet;
  for (int c = 0; c < 3; ++c) facet[c] = std::max(0.f, bare[c] + (1 - bare[c]) * more_[c]);
  return facet;
}

/// Returns a facet's reflectance. From inside it mirrors what it mirrors of the light that comes the same way from
/// outside.
Spectrum PrincipledLayers::glass_facet(float cos, float eta) const {
  if (outside_) return dielectric_facet(cos, eta);
  const float beyond = 1 / eta;
  if (!film_) return Spectrum(fresnel_dielectric(cos, beyond));
  const float sin2_outside = (1 - cos * cos) / (beyond * beyond);
  return sin2_outside >= 1 ? Spectrum(1) : dielectric_facet(std::sqrt(1 - sin2_outside), eta);
}

Spectrum PrincipledLayers::mirrored_by_facet(float cos_facet, const Way& o, const Way& i) const {
  Spectrum sum;
  const float passed = o.share * i.share;
  if (metal_ > 0) sum += metal_facet(cos_facet) * (metal_ * passed);
  if (opaque_ > 0) sum += opaque_facet(cos_facet) * (opaque_ * specular_ * passed);
  if (glass_ == 0) return sum;
  const Spectrum glass = glass_facet(cos_facet, mirroring_eta_);
  return sum + (glass + (Spectrum(1) - glass) * sent_back(cos_facet, o, i)) * (glass_ * over_glass(o, i));
}

Spectrum PrincipledLayers::through_facet(float cos_facet, const Way& o, const Way& i) const {
  const Spectrum passes = (Spectrum(1) - glass_facet(cos_facet, eta_)) * glass_;
  if (thin_) return base_ * passes * (o.share * i.share);
  const Spectrum tint = map(base_, [](float c) { return std::sqrt(c); });
  return tint * passes * (outside_ ? o.left : i.left);
}

Spectrum PrincipledLayers::through(const Vec3& o, const Vec3& i, const Way& way_o, const Way& way_i,
                                   Transport transport) const {
  if (thin_) {
    const Vec3 mirrored = other_side(i), m = normalize(o + mirrored);
    return through_facet(dot(o, m), way_o, way_i) * facets_.reflection(o, mirrored, m);
  }
  const auto facet = facet_between(o, i, eta());
  if (!facet) return {};
  return through_facet(dot(o, facet->m), way_o, way_i) *
         (refraction(facets_, o, i, *facet) * transport_scale(transport, eta()));
}

float PrincipledLayers::density_through(const Vec3& o, const Vec3& i) const {
  if (thin_) return facets_.reflection_density(o, normalize(o + other_side(i)));
  const auto facet = facet_between(o, i, eta());
  return facet ? refraction_density(facets_, o, *facet) : 0;
}

/// Returns the ground's f for light that comes from one side and leaves on the same, or beyond.
Spectrum PrincipledLayers::ground(const Way& o, const Way& i, bool beyond) const {
  if (!(opaque_ > 0) || !(diffuse_norm_ > 1e-6f)) return {};
  const Spectrum colour = beyond ? beyond_colour_ * beyond_ : base_ * (1 - beyond_);
  return colour * (opaque_ / kPi * left_to_ground(o) * left_to_ground(i) / diffuse_norm_);
}

Spectrum PrincipledLayers::diffuse(const Vec3& o, const Vec3& i, const Way& way_o, const Way& way_i) const {
  Spectrum sum = ground(way_o, way_i, false);
  if (metal_ > 0 && !smooth_) sum += made_up_by_metal(way_o, way_i) * metal_;
  if (glass_ > 0 && !smooth_) sum += made_up_by_glass(way_o, way_i) * glass_;
  if (sheen_weight_ > 0) sum += sheen_ * (covered_ * Sheen(sheen_alpha_).f(o, i));
  return sum;
}

Spectrum PrincipledLayers::f(const Vec3& o, const Vec3& i, Transport transport, LobeSet lobes) const {
  const bool beyond = i.z < 0;
  const Tilts tilts = beyond ? as_they_are() : as_seen(transport == Transport::radiance ? o : i);
  const Way way_o = way(o, tilts), way_i = way(i, tilts);
  Spectrum sum;
  if (beyond) {
    if ((lobes & Principled::kThrough) && !smooth_ && glass_ > 0) sum += through(o, i, way_o, way_i, transport);
    if ((lobes & Principled::kDiffuse) && beyond_ > 0) sum += ground(way_o, way_i, true);
    return sum;
  }
  if ((lobes & Principled::kSpecular) && !smooth_)
    if (const Tilt::Pair w = tilts.facets.pair(o, i, transport); w.above)
      sum += mirrored_by_facet(dot(w.o, w.m), way_o, way_i) * (facets_.reflection(w.o, w.i, w.m) * w.factor);
  if ((lobes & Principled::kCoat) && !smooth_coat_ && coat_ > 0)
    if (const Tilt::Pair w = tilts.coat.pair(o, i, transport); w.above)
      sum += Spectrum(covered_ * coat_ * coat_under_sheen(o.z) * coat_under_sheen(i.z) *
                      fresnel_dielectric(dot(w.o, w.m), kCoatEta) * coat_facets_.reflection(w.o, w.i, w.m) * w.factor);
  if (lobes & Principled::kDiffuse) sum += diffuse(o, i, way_o, way_i);
  return sum;
}

}  // namespace dspm
