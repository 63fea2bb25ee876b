// dielectric: glass, water; smooth or rough, with light passing into the body.
//
//   Material "dielectric" "float eta" 1.33
//
//   eta                   float or spectrum   1.5         index of refraction inside over outside
//   roughness             float texture       0           of both directions
//   uroughness            float texture       roughness   along the first tangent
//   vroughness            float texture       roughness   across it
//   remaproughness        bool                true        alpha is sqrt(roughness), else roughness itself
//   attenuationcolor      spectrum            1           of white light after attenuationdistance in the body
//   attenuationdistance   float               1           in world units
//
// Inside is the side away from the geometric normal. A spectrum for eta is averaged over the colours: there is no
// dispersion. Rough glass is GGX; light that hits a second facet is lost. Coloured glass absorbs within the body: after a
// distance d, attenuationcolor^(d / attenuationdistance) is left (Beer's law). The body ends at its mesh, which should be
// closed; what is opaque may lie in it. Of two bodies of which one lies within the other, the inner one counts.
// [Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces; glTF 2.0, KHR_materials_volume]
#include <algorithm>
#include <cmath>

#include "dspm/colour/rgb.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/interface.h"
#include "dspm/materials/material.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/rough_boundary.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"

namespace dspm {
namespace {

class SmoothDielectric final : public Bsdf {
 public:
  SmoothDielectric(const ShadingFrame& frame, float eta) : frame_(frame), eta_(eta) {}

  LobeSet lobes(float least_alpha) const override { return least_alpha <= 0 ? kBothLobes : 0; }
  Rgb evaluate(const Vec3&, const Vec3&, Transport, LobeSet) const override { return {}; }
  float pdf_w(const Vec3&, const Vec3&, Transport, LobeSet) const override { return 0; }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    const float side = frame_.side(wo), eta = side > 0 ? eta_ : 1 / eta_;
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!(lobes & kBothLobes) || !arriving) return std::nullopt;
    const Vec3 o = *arriving;
    const float fresnel = fresnel_dielectric(o.z, eta), chance = chance_of_reflection(fresnel, lobes);
    const bool reflected = u.z < chance;
    const std::optional<Vec3> i = reflected ? Vec3{-o.x, -o.y, o.z} : refract(o, {0, 0, 1}, eta);
    const float weight = reflected ? fresnel / chance : (1 - fresnel) / (1 - chance) * transport_scale(transport, eta);
    if (!i || weight == 0) return std::nullopt;
    const auto leaving = frame_.leave(*i, side, transport, u.x);
    if (!leaving) return std::nullopt;
    return BsdfSample{leaving->wi, Rgb(weight / leaving->share), 0, true,
                      reflected ? 1 : transport_scale(transport, eta)};
  }

  float lobe_probability(const Vec3& wo, LobeSet lobes) const override {
    const float side = frame_.side(wo), cos_o = std::abs(frame_.local(wo, side).z);
    const float fresnel = fresnel_dielectric(cos_o, side > 0 ? eta_ : 1 / eta_);
    return share_of(fresnel, lobes);
  }

 private:
  ShadingFrame frame_;
  float eta_;
};

class RoughDielectric final : public Bsdf {
 public:
  RoughDielectric(const ShadingFrame& frame, const Ggx& facets, float eta)
      : frame_(frame), facets_(facets), eta_(eta) {}

  LobeSet lobes(float least_alpha) const override { return facets_.least_alpha() >= least_alpha ? kBothLobes : 0; }
  bool transmits(LobeSet lobes) const override { return (lobes & kTransmission) != 0; }

  Rgb evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    const std::optional<Facet> facet = facet_of(w, lobes);
    if (!facet) return {};
    if (w.reflection()) return Rgb(facet->fresnel * facets_.reflection(w.wo, w.wi, facet->m));
    const float scale = transport_scale(transport, eta_from(w.side));
    return Rgb((1 - facet->fresnel) * refraction(facets_, w.wo, w.wi, *facet) * scale);
  }

  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    const std::optional<Facet> facet = facet_of(w, lobes);
    if (!facet) return 0;
    const float reflected = chance_of_reflection(facet->fresnel, lobes);
    if (w.reflection()) return w.share * reflected * facets_.reflection_density(w.wo, facet->m);
    return w.share * (1 - reflected) * refraction_density(facets_, w.wo, *facet);
  }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    const float side = frame_.side(wo), eta = eta_from(side);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!(lobes & kBothLobes) || !arriving) return std::nullopt;
    const Vec3 o = *arriving;
    const Vec3 m = facets_.sample_visible(o, u.x, u.y);
    const float fresnel = fresnel_dielectric(dot(o, m), eta), chance = chance_of_reflection(fresnel, lobes);
    const bool reflected = u.z < chance;
    const std::optional<Vec3> i = reflected ? reflect(o, m) : refract(o, m, eta);
    if (!i || (i->z > 0) != reflected) return std::nullopt;
    const auto leaving = frame_.leave(*i, side, transport, u.x);
    if (!leaving) return std::nullopt;
    if (reflected) {
      const float weight = fresnel / chance * facets_.visible_after(o, *i);
      return BsdfSample{leaving->wi, Rgb(weight / leaving->share),
                        leaving->share * chance * facets_.reflection_density(o, m), false};
    }
    const float weight = (1 - fresnel) / (1 - chance) * facets_.visible_after(o, *i);
    const float pdf_w = (1 - chance) * facets_.visible_density(o, m) * solid_angle_ratio(o, *i, m, eta);
    const float scale = transport_scale(transport, eta);
    return BsdfSample{leaving->wi, Rgb(weight * scale / leaving->share), leaving->share * pdf_w, false, scale};
  }

  float lobe_probability(const Vec3& wo, LobeSet lobes) const override;

 private:
  float eta_from(float side) const { return side > 0 ? eta_ : 1 / eta_; }
  /// The facet that sends light from wo to wi, by one of `lobes`.
  std::optional<Facet> facet_of(const LocalPair& w, LobeSet lobes) const {
    if (!w.valid || !(lobes & (w.reflection() ? kReflection : kTransmission))) return std::nullopt;
    return facet_between(w.wo, w.wi, eta_from(w.side));
  }

  ShadingFrame frame_;
  Ggx facets_;
  float eta_;
};

/// The mean Fresnel reflectance of the facets visible from wo, by a midpoint rule (to about 1e-3). The lobes are
/// equally rough, so no integrator asks for one of them alone in an inner loop. (A lobe alone is sampled from all
/// facets, not from those that would have chosen it.)
float RoughDielectric::lobe_probability(const Vec3& wo, LobeSet lobes) const {
  if ((lobes & kBothLobes) == kBothLobes) return 1;
  const float side = frame_.side(wo), eta = side > 0 ? eta_ : 1 / eta_;
  Vec3 o = frame_.local(wo, side);
  o.z = std::max(std::abs(o.z), 1e-6f);
  constexpr int kSteps = 16;
  float sum = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const float u = (static_cast<float>(i % kSteps) + 0.5f) / kSteps;
    const float v = (static_cast<float>(i / kSteps) + 0.5f) / kSteps;
    sum += fresnel_dielectric(dot(o, facets_.sample_visible(o, u, v)), eta);
  }
  return share_of(sum / (kSteps * kSteps), lobes);
}

/// Near an index of 1 facets hardly turn light aside, so what meets a second one is not lost, as the model has it: the
/// roughness fades, and glass vanishes as its index comes to 1.
float share_of_roughness(float eta) {
  constexpr float kFull = 0.05f;
  return std::min(std::abs(eta - 1) / kFull, 1.f);
}

class DielectricMaterial final : public Material {
 public:
  DielectricMaterial(ParamReader& reader, const MaterialContext& context)
      : eta_(read_eta(reader)), roughness_(reader, context), absorption_(read_absorption(reader)) {}

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const ShadingFrame frame(point);
    const Vec2 alpha = roughness_.alpha(point) * share_of_roughness(eta_);
    if (Ggx::is_smooth(alpha) || eta_ == 1) return slot.emplace<SmoothDielectric>(frame, eta_);
    return slot.emplace<RoughDielectric>(frame, Ggx(alpha), eta_);
  }
  bool bounds_a_body() const override { return true; }
  Rgb absorption() const override { return absorption_; }

 private:
  float eta_;
  Roughness roughness_;
  Rgb absorption_;
};

}  // namespace

std::unique_ptr<Material> make_dielectric(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<DielectricMaterial>(reader, context);
  reader.finish();
  return material;
}

}  // namespace dspm
