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
//   g, albedo                             0           of a medium in the coat; only 0 is supported
//   thickness, maxdepth, nsamples                     of pbrt's random walk; read, but without effect
//
// Both sides are coated. The coat mirrors (smooth, or GGX). The light that it transmits is scattered by the base,
// partly reflected back by the coat from inside, scattered again, and so on: a geometric series, with a = reflectance,
//   f = F-mirror or GGX + (1 - F(wo)) (1 - F(wi)) / eta^2 * a / (pi (1 - a F_in)),
// where F_in is the mean Fresnel reflectance for diffuse light from inside. A smooth coat over a white base loses
// nothing.
// pbrt estimates the same layers by a random walk, whose values are random; this is exact for a smooth coat without a
// medium. For a rough one pbrt also refracts through the facets; here light enters as if the coat were smooth, and
// for indices outside 1 to 4, the facets' Fresnel term is bounded by the smooth coat's.
// [Wolff 1994, Diffuse-Reflectance Model for Smooth Dielectric Surfaces]
#include <algorithm>
#include <typeinfo>

#include "dspm/colour/rgb.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/interface.h"
#include "dspm/materials/material.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/math/sampling.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"

namespace dspm {
namespace {

/// The coat mirrors; the base gets the light that the coat transmits.
constexpr LobeSet kCoat = kReflection, kBase = kTransmission;

class CoatedDiffuse final : public Bsdf {
 public:
  /// `base` is the factor of (1 - F(wo)) (1 - F(wi)).
  CoatedDiffuse(const ShadingFrame& frame, Vec2 alpha, float eta, const Rgb& base)
      : frame_(frame),
        facets_(alpha),
        smooth_(Ggx::is_smooth(alpha) || eta == 1),
        eta_(eta),
        base_(base),
        base_weight_(weight_in_choice(kPi * eta * eta * max_component(base))) {}

  LobeSet lobes(float least_alpha) const override {
    const float coat_alpha = smooth_ ? 0 : facets_.least_alpha();
    return coat_alpha >= std::max(least_alpha, 0.f) ? kBothLobes : kBase;
  }

  Rgb evaluate(const Vec3& wo, const Vec3& wi, Transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi);
    return w.reflection() ? f(w.wo, w.wi, lobes) : Rgb(0);
  }

  float pdf_w(const Vec3& wo, const Vec3& wi, Transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi);
    return w.reflection() ? density(w.wo, w.wi, lobes) : 0;
  }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    const Vec3 o = frame_.local(wo, side);
    const bool nothing_mirrors = eta_ == 1 && !(lobes & kBase);
    if (!(lobes & kBothLobes) || o.z <= 0 || nothing_mirrors) return std::nullopt;
    const float chance = chance_of_coat(o, lobes);
    const bool coat = u.z < chance;
    const Vec3 i = !coat     ? cosine_hemisphere({u.x, u.y})
                   : smooth_ ? Vec3{-o.x, -o.y, o.z}
                             : reflect(o, facets_.sample_visible(o, u.x, u.y));
    if (i.z <= 0) return std::nullopt;
    const std::optional<Vec3> wi = frame_.leave(i, side);
    if (!wi) return std::nullopt;
    if (coat && smooth_) return BsdfSample{*wi, Rgb(fresnel_dielectric(o.z, eta_) / chance), 0, true};
    const float pdf = density(o, i, lobes);
    return BsdfSample{*wi, f(o, i, lobes) * (i.z / pdf), pdf, false};
  }

  float lobe_probability(const Vec3& wo, LobeSet lobes) const override {
    return share_of(share_of_coat(std::max(0.f, frame_.local(wo, frame_.side(wo)).z)), lobes);
  }

  std::optional<Rgb> ratio_to(const Bsdf& other, LobeSet lobes) const override {
    if (typeid(other) != typeid(CoatedDiffuse)) return std::nullopt;
    const auto& o = static_cast<const CoatedDiffuse&>(other);
    if (eta_ != o.eta_ || ((lobes & kCoat) && !(smooth_ && o.smooth_))) return std::nullopt;
    return ratio(base_, o.base_);
  }

 private:
  /// A dark base must not take all paths from the coat. In steps, so that finishes whose bases are about equally bright
  /// choose alike and stay one path.
  static float weight_in_choice(float reflectance) {
    return reflectance >= 1 / 4.f ? 1 : reflectance >= 1 / 16.f ? 1 / 4.f : 1 / 16.f;
  }

  float share_of_coat(float cos_o) const {
    const float mirrored = fresnel_dielectric(cos_o, eta_);
    return mirrored / (mirrored + (1 - mirrored) * base_weight_);
  }
  float chance_of_coat(const Vec3& o, LobeSet lobes) const { return chance_of_reflection(share_of_coat(o.z), lobes); }

  /// Both above the surface; as for the density.
  Rgb f(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    Rgb sum;
    if (lobes & kBase) sum += base_ * ((1 - fresnel_dielectric(o.z, eta_)) * (1 - fresnel_dielectric(i.z, eta_)));
    if ((lobes & kCoat) && !smooth_) {
      const Vec3 m = normalize(o + i);
      sum += Rgb(mirrored_by_facet(dot(o, m), o.z, i.z) * facets_.reflection(o, i, m));
    }
    return sum;
  }

  // The base gets the light that a smooth coat transmits. For indices of 1 to 4, facets mirror hardly more than the
  // remainder, 0.3% at most. Outside that range, total reflection or Brewster's angle near grazing make it up to 26%:
  // there a facet mirrors no more than the smooth coat does for either direction.
  float mirrored_by_facet(float cos, float cos_o, float cos_i) const {
    const float mirrored = fresnel_dielectric(cos, eta_);
    if (eta_ >= 1 && eta_ <= 4) return mirrored;
    return std::min({mirrored, fresnel_dielectric(cos_o, eta_), fresnel_dielectric(cos_i, eta_)});
  }

  float density(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    const float coat = chance_of_coat(o, lobes);
    float sum = 0;
    if (lobes & kBase) sum += (1 - coat) * i.z / kPi;
    if ((lobes & kCoat) && !smooth_) sum += coat * facets_.reflection_density(o, normalize(o + i));
    return sum;
  }

  ShadingFrame frame_;
  Ggx facets_;
  bool smooth_;
  float eta_;
  Rgb base_;
  float base_weight_;  // of the transmitted light, when a lobe is chosen
};

class CoatedDiffuseMaterial final : public Material {
 public:
  CoatedDiffuseMaterial(ParamReader& reader, const MaterialContext& context)
      : eta_(read_eta(reader)), let_in_(1 - mean_fresnel_outside(eta_)), roughness_(reader, context) {
    const auto reflectance = reader.rgb_or_texture("reflectance", Rgb(0.5f), SpectrumRole::albedo, "of the base");
    reflectance_ = texture_of(reflectance, context.textures, reader.diagnostics());
  }

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const Rgb a = clamped_albedo(reflectance_->evaluate(texture_point(point)));
    Rgb base;
    for (int c = 0; c < 3; ++c) {
      // eta^2 (1 - a F_in), which is 0 if no light gets in. By reciprocity, 1 - F_in is let_in / eta^2.
      const float remaining = eta_ * eta_ * (1 - a[c]) + a[c] * let_in_;
      base[c] = remaining > 0 ? a[c] / (kPi * remaining) : 0;
    }
    return slot.emplace<CoatedDiffuse>(ShadingFrame(point), roughness_.alpha(point), eta_, base);
  }

 private:
  float eta_, let_in_;  // let_in: the fraction of diffuse light that enters the coat
  Roughness roughness_;
  TexturePtr<Rgb> reflectance_;
};

/// The parameters of pbrt's random walk through the coat and its medium.
void read_random_walk(ParamReader& reader) {
  const float g = reader.number("g", 0, "", "asymmetry of a medium in the coat; only 0 is supported");
  const auto albedo =
      reader.rgb_or_texture("albedo", Rgb(0), SpectrumRole::albedo, "of that medium; only 0 is supported");
  const auto refuse = [&](std::string_view name) {
    reader.diagnostics().unsupported(reader.where(name),
                                     reader.subject() + ": a medium in the coat is not supported by dspm");
  };
  if (g != 0) refuse("g");
  if (!albedo.texture.empty() || !is_black(albedo.value)) refuse("albedo");
  reader.number("thickness", 0.01f, "", "of the coat; without effect");
  reader.integer("maxdepth", 10, "", "of pbrt's random walk; without effect");
  reader.integer("nsamples", 1, "", "of pbrt's random walk; without effect");
  for (const char* name : {"thickness", "maxdepth", "nsamples"}) {
    if (!reader.has(name)) continue;
    reader.warning(
        name, "parameter \"" + std::string(name) + "\" of " + reader.subject() + " has no effect in dspm",
        "the coat is evaluated exactly, without pbrt's random walk and its thickness, maxdepth and nsamples");
    break;
  }
}

}  // namespace

std::unique_ptr<Material> make_coateddiffuse(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<CoatedDiffuseMaterial>(reader, context);
  read_random_walk(reader);
  reader.finish();
  return material;
}

}  // namespace dspm
