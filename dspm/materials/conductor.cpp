// conductor: metal, smooth or rough.
//
//   Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k" "float roughness" 0.1
//
//   eta, k           spectrum texture   metal-Cu-eta, metal-Cu-k   complex index of refraction eta + ik
//   reflectance      spectrum texture   none                       at normal incidence, instead of eta and k
//   roughness        float texture      0                          of both directions
//   uroughness       float texture      roughness                  along the first tangent
//   vroughness       float texture      roughness                  across it
//   remaproughness   bool               true                       alpha is sqrt(roughness), else roughness itself
//
// Both sides reflect. Rough metal is GGX with Smith's height-correlated shadowing; light that hits a second facet is
// lost (tests/materials/energy_test.cpp states how much). A reflectance r stands for eta = 1, k = 2 sqrt(r / (1 - r)).
// [Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces; Heitz 2014]
#include "dspm/colour/rgb.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/material.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"

namespace dspm {
namespace {

class SmoothConductor final : public Bsdf {
 public:
  SmoothConductor(const ShadingFrame& frame, const MetalIndex& index) : frame_(frame), index_(index) {}

  LobeSet lobes(float least_alpha) const override { return least_alpha <= 0 ? 1 : 0; }
  Rgb evaluate(const Vec3&, const Vec3&, Transport, LobeSet) const override { return {}; }
  float pdf_w(const Vec3&, const Vec3&, Transport, LobeSet) const override { return 0; }
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!(lobes & 1) || !arriving) return std::nullopt;
    const Vec3 o = *arriving;
    const auto leaving = frame_.leave({-o.x, -o.y, o.z}, side, transport, u.x);
    if (!leaving) return std::nullopt;
    return BsdfSample{leaving->wi, fresnel_conductor(o.z, index_.eta, index_.k) / leaving->share, 0, true};
  }
  float lobe_probability(const Vec3&, LobeSet lobes) const override { return lobes & 1 ? 1.f : 0.f; }

 private:
  ShadingFrame frame_;
  MetalIndex index_;
};

class RoughConductor final : public Bsdf {
 public:
  RoughConductor(const ShadingFrame& frame, const Ggx& facets, const MetalIndex& index)
      : frame_(frame), facets_(facets), index_(index) {}

  LobeSet lobes(float least_alpha) const override { return facets_.least_alpha() >= least_alpha ? 1 : 0; }

  Rgb evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    if (!(lobes & 1) || !w.reflection()) return {};
    const Vec3 m = normalize(w.wo + w.wi);
    return fresnel_conductor(dot(w.wo, m), index_.eta, index_.k) * facets_.reflection(w.wo, w.wi, m);
  }

  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    if (!(lobes & 1) || !w.reflection()) return 0;
    return w.share * facets_.reflection_density(w.wo, normalize(w.wo + w.wi));
  }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!(lobes & 1) || !arriving) return std::nullopt;
    const Vec3 o = *arriving;
    const Vec3 m = facets_.sample_visible(o, u.x, u.y), i = reflect(o, m);
    if (i.z <= 0) return std::nullopt;
    const auto leaving = frame_.leave(i, side, transport, u.x);
    if (!leaving) return std::nullopt;
    const Rgb weight = fresnel_conductor(dot(o, m), index_.eta, index_.k) * facets_.visible_after(o, i);
    return BsdfSample{leaving->wi, weight / leaving->share, leaving->share * facets_.reflection_density(o, m), false};
  }

  float lobe_probability(const Vec3&, LobeSet lobes) const override { return lobes & 1 ? 1.f : 0.f; }

 private:
  ShadingFrame frame_;
  Ggx facets_;
  MetalIndex index_;
};

class ConductorMaterial final : public Material {
 public:
  ConductorMaterial(ParamReader& reader, const MaterialContext& context)
      : roughness_(reader, context), metal_(reader, context) {}

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const ShadingFrame frame(point);
    const Vec2 alpha = roughness_.alpha(point);
    if (Ggx::is_smooth(alpha)) return slot.emplace<SmoothConductor>(frame, metal_.index(point));
    return slot.emplace<RoughConductor>(frame, Ggx(alpha), metal_.index(point));
  }

 private:
  Roughness roughness_;
  MetalLook metal_;
};

}  // namespace

std::unique_ptr<Material> make_conductor(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<ConductorMaterial>(reader, context);
  reader.finish();
  return material;
}

}  // namespace dspm
