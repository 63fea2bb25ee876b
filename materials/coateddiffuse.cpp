// coateddiffuse: a diffuse base under a clear coat, such as plastic, varnished wood or glazed clay.
//
//   Material "coateddiffuse" "rgb reflectance" [.6 .1 .1] "float roughness" 0.1
//
//   reflectance       spectrum texture    0.5         of the base
//   eta               float or spectrum   1.5         index of refraction of the coat over outside
//   roughness         float texture       0           of the coat's surface, in both directions
//   uroughness        float texture       roughness   along the first tangent
//   vroughness        float texture       roughness   across it
//   remaproughness    bool                true        alpha is sqrt(roughness), else roughness itself
//   energycompensation   bool             true        false in .pbrt files: see below
//   g, albedo                             0           of a medium in the coat; only 0 is supported
//   thickness, maxdepth, nsamples         0.01, 10, 1 of pbrt's random walk, see below
//
// Both sides are coated. The coat mirrors (smooth, or GGX). The light that it transmits is scattered by the base,
// partly reflected back by the coat from inside, scattered again, and so on: a geometric series, with a = reflectance,
//   f = F-mirror or GGX + (1 - F(wo)) (1 - F(wi)) / eta^2 * a / (pi (1 - a F_in)),
// where F_in is the mean Fresnel reflectance for diffuse light from inside. A rough coat lets in what its facets do not
// mirror: F is their albedo then (made_up.h). So a coat over a white base loses nothing. For indices outside 1 to 4,
// light enters a rough coat as if it were smooth, and the facets' Fresnel term is bounded by the smooth coat's.
//
// Without energycompensation, the coat loses what pbrt's random walk loses: exp(-thickness / cos) on each way through
// it, what is left after maxdepth / 2 (rounded up) visits of the base, and light that meets two facets of a rough coat.
// As the base is diffuse, the walk's mean is a series as well,
//   f = F-mirror or GGX + t(wo) t(wi) / eta^2 * a / pi * sum over k of (a G)^k,
// with t the albedo of refraction by the facets times exp(-thickness / cos inside), and G that of their reflection of
// diffuse light from inside, there and back through the coat. nsamples has no effect: there is no noise.
// [Wolff 1994, Diffuse-Reflectance Model for Smooth Dielectric Surfaces; Pharr, Jakob and Humphreys 2023, Physically
// Based Rendering, 14.3]
#include <algorithm>
#include <cmath>
#include <typeinfo>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/coat.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/interface.h"
#include "dspm/materials/material.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/shading_frame.h"

namespace dspm {
namespace {

/// The coat mirrors; the base gets the light that the coat transmits.
constexpr LobeSet kCoatLobe = kReflection, kBaseLobe = kTransmission;

class CoatedDiffuse final : public Bsdf {
 public:
  /// `base` is the factor of what the coat lets through for wo and for wi. The coat must outlive it.
  CoatedDiffuse(const ShadingFrame& frame, Vec2 alpha, const Coat& coat, const Spectrum& base)
      : frame_(frame),
        coat_(&coat),
        facets_(alpha),
        smooth_(Ggx::is_smooth(alpha) || coat.eta == 1),
        eta_(coat.eta),
        base_(base),
        base_weight_(weight_in_choice(kPi * eta_ * eta_ * max_component(base))) {}

  LobeSet lobes(float least_alpha) const override {
    const float coat_alpha = smooth_ ? 0 : facets_.least_alpha();
    return coat_alpha >= std::max(least_alpha, 0.f) ? kBothLobes : kBaseLobe;
  }

  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    return w.reflection() ? f(w.wo, w.wi, lobes) : Spectrum(0);
  }

  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    return w.reflection() ? w.share * density(w.wo, w.wi, lobes) : 0;
  }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    const auto arriving = frame_.arrive(wo, side, transport);
    const bool nothing_mirrors = eta_ == 1 && !(lobes & kBaseLobe);
    if (!(lobes & kBothLobes) || !arriving || nothing_mirrors) return std::nullopt;
    const Vec3 o = *arriving;
    const float chance = chance_of_coat(o, lobes);
    const bool coat = u.z < chance;
    const Vec3 i = !coat     ? cosine_hemisphere({u.x, u.y})
                   : smooth_ ? Vec3{-o.x, -o.y, o.z}
                             : reflect(o, facets_.sample_visible(o, u.x, u.y));
    if (i.z <= 0) return std::nullopt;
    const auto leaving = frame_.leave(i, side, transport, u.x);
    if (!leaving) return std::nullopt;
    if (coat && smooth_)
      return BsdfSample{leaving->wi, Spectrum(fresnel_dielectric(o.z, eta_) / (chance * leaving->share)), 0, true};
    const float pdf = leaving->share * density(o, i, lobes);
    return BsdfSample{leaving->wi, f(o, i, lobes) * (i.z / pdf), pdf, false};
  }

  float lobe_probability(const Vec3& wo, LobeSet lobes) const override {
    return share_of(share_of_coat(std::abs(frame_.local(wo, frame_.side(wo)).z)), lobes);
  }

  std::optional<Spectrum> ratio_to(const Bsdf& other, LobeSet lobes) const override {
    if (typeid(other) != typeid(CoatedDiffuse)) return std::nullopt;
    const auto& o = static_cast<const CoatedDiffuse&>(other);
    if (eta_ != o.eta_ || ((lobes & kCoatLobe) && !(smooth_ && o.smooth_)) || !lets_through_as(o)) return std::nullopt;
    return ratio(base_, o.base_);
  }

 private:
  /// Limits what a dark base takes from the coat: it must not take all paths. It goes in steps, so that finishes whose
  /// bases are about equally bright choose alike and stay one path.
  static float weight_in_choice(float reflectance) {
    return reflectance >= 1 / 4.f ? 1 : reflectance >= 1 / 16.f ? 1 / 4.f : 1 / 16.f;
  }

  bool lets_through_as(const CoatedDiffuse& o) const {
    if (coat_->loses != o.coat_->loses || coat_->thickness != o.coat_->thickness) return false;
    const bool either = coat_->facets || o.coat_->facets;
    return !either || (smooth_ && o.smooth_) || facets_.alpha() == o.facets_.alpha();
  }
  float let_through(const Vec3& w) const { return coat_->let_through(w, smooth_, facets_); }

  float share_of_coat(float cos_o) const {
    const float mirrored = fresnel_dielectric(cos_o, eta_);
    return mirrored / (mirrored + (1 - mirrored) * base_weight_);
  }
  float chance_of_coat(const Vec3& o, LobeSet lobes) const { return chance_of_reflection(share_of_coat(o.z), lobes); }

  /// Returns f for directions above the surface, as does the density.
  Spectrum f(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    Spectrum sum;
    if (lobes & kBaseLobe) sum += base_ * (let_through(o) * let_through(i));
    if ((lobes & kCoatLobe) && !smooth_) {
      const Vec3 m = normalize(o + i);
      sum += Spectrum(coat_->mirrored_by_facet(dot(o, m), o.z, i.z) * facets_.reflection(o, i, m));
    }
    return sum;
  }

  float density(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    const float coat = chance_of_coat(o, lobes);
    float sum = 0;
    if (lobes & kBaseLobe) sum += (1 - coat) * i.z / kPi;
    if ((lobes & kCoatLobe) && !smooth_) sum += coat * facets_.reflection_density(o, normalize(o + i));
    return sum;
  }

  ShadingFrame frame_;
  const Coat* coat_;
  Ggx facets_;
  bool smooth_;
  float eta_;
  Spectrum base_;
  float base_weight_;  // of the transmitted light, when a lobe is chosen
};

class CoatedDiffuseMaterial final : public Material {
 public:
  CoatedDiffuseMaterial(ParamReader& reader, const MaterialContext& context)
      : coat_{read_eta(reader)},
        let_in_(1 - mean_fresnel_outside(coat_.eta)),
        roughness_(reader, context),
        makes_up_(read_energy_compensation(reader, context)) {
    const auto reflectance = reader.rgb_or_texture("reflectance", Rgb(0.5f), SpectrumRole::albedo, "of the base");
    reflectance_ = texture_of(reflectance, context.textures, reader.diagnostics());
    walk_ = read_random_walk(reader, !makes_up_);
  }

  /// Call this after the parameters have been checked.
  void make_tables() {
    if (!makes_up_) return lose_as_in_pbrt();
    if (roughness_.is_smooth() || !coat_.is_usual()) return;
    coat_.facets = boundary_tables(coat_.eta);
    if (!roughness_.is_even()) coat_.brushed = brushed_dielectric(coat_.eta);
  }

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const Spectrum a = clamped_albedo(reflectance_->carried(texture_point(point)));
    const Vec2 alpha = roughness_.alpha(point);
    return slot.emplace<CoatedDiffuse>(ShadingFrame(point), alpha, coat_,
                                       coat_.loses ? walked(a, alpha) : all(a, alpha));
  }

 private:
  void lose_as_in_pbrt() {
    coat_.loses = true, coat_.thickness = walk_.thickness;
    coat_.facets = boundary_tables(coat_.eta);
    constexpr int kSteps = 1024;
    float without = 0;
    for (int i = 0; i < kSteps; ++i) {
      const float cos = (static_cast<float>(i) + 0.5f) / kSteps;
      const float mirrored = 2 * cos * fresnel_dielectric(cos, 1 / coat_.eta) / kSteps;
      without += mirrored, mirrored_inside_ += mirrored * coat_.left(cos) * coat_.left(cos);
    }
    left_inside_ = without > 0 ? mirrored_inside_ / without : 1;
  }

  /// Returns the base's factor over eta^2, which is 0 if no light gets in. By reciprocity, 1 - F_in is let_in / eta^2.
  Spectrum all(const Spectrum& a, Vec2 alpha) const {
    const bool smooth = Ggx::is_smooth(alpha) || !coat_.facets;
    const float let_in = smooth ? let_in_ : 1 - coat_.mirrored(Ggx(alpha)).mean();
    Spectrum base;
    for (int c = 0; c < 3; ++c) {
      const float remaining = coat_.eta * coat_.eta * (1 - a[c]) + a[c] * let_in;
      base[c] = remaining > 0 ? a[c] / (kPi * remaining) : 0;
    }
    return base;
  }
  Spectrum walked(const Spectrum& a, Vec2 alpha) const {
    const bool smooth = Ggx::is_smooth(alpha) || coat_.eta == 1;
    const float back =
        smooth ? mirrored_inside_ : left_inside_ * coat_.facets->inside.reflected.mean(Coat::mean_alpha(Ggx(alpha)));
    Spectrum base;
    for (int c = 0; c < 3; ++c) {
      const float again = a[c] * back;
      const float sum = again < 1 ? (1 - rounded::pow(again, static_cast<float>(walk_.visits))) / (1 - again)
                                  : static_cast<float>(walk_.visits);
      base[c] = a[c] * sum / (kPi * coat_.eta * coat_.eta);
    }
    return base;
  }

  Coat coat_;
  float let_in_;  // the fraction of diffuse light that enters the coat, if it is smooth
  Roughness roughness_;
  bool makes_up_;
  TexturePtr<Rgb> reflectance_;
  RandomWalk walk_;
  float mirrored_inside_ = 0;  // the fraction of diffuse light that a smooth coat sends back to the base
  float left_inside_ = 1;      // of it, what the way through the coat leaves
};

}  // namespace

std::unique_ptr<Material> make_coateddiffuse(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<CoatedDiffuseMaterial>(reader, context);
  reader.finish();
  material->make_tables();
  return material;
}

}  // namespace dspm
