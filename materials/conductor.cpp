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
//   energycompensation   bool           true                       false in .pbrt files: see below
//
// Both sides reflect. Rough metal is GGX with Smith's height-correlated shadowing, and a diffuse lobe for light that
// meets a second facet (made_up.h), coloured by two or more reflections; without energycompensation that light is lost,
// as in pbrt (tests/materials/energy_test.cpp states how much). A reflectance r stands for eta = 1,
// k = 2 sqrt(r / (1 - r)).
// [Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces; Heitz 2014; Kulla and Conty 2017]
#include <algorithm>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/made_up.h"
#include "dspm/materials/material.h"
#include "dspm/materials/metal_tables.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/shading_frame.h"

namespace dspm {
namespace {

class SmoothConductor final : public Bsdf {
 public:
  SmoothConductor(const ShadingFrame& frame, const MetalIndex& index) : frame_(frame), index_(index) {}

  LobeSet lobes(float least_alpha) const override { return least_alpha <= 0 ? 1 : 0; }
  Spectrum evaluate(const Vec3&, const Vec3&, Transport, LobeSet) const override { return {}; }
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
  static constexpr LobeSet kFacets = 1, kMadeUp = 2;

  /// `tables` must outlive it; null means that what meets a second facet is lost.
  RoughConductor(const ShadingFrame& frame, const Ggx& facets, const MetalIndex& index, const MetalTables* tables)
      : frame_(frame), facets_(facets), index_(index), tables_(tables) {}

  LobeSet lobes(float least_alpha) const override {
    const LobeSet mirrors = facets_.least_alpha() >= least_alpha ? kFacets : 0;
    return static_cast<LobeSet>(mirrors | (tables_ != nullptr ? kMadeUp : 0));
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
    if (!(lobes & this->lobes(0)) || !arriving) return std::nullopt;
    const Vec3 o = *arriving;
    const bool by_facets = u.z < 1 - chance_of_made_up(o, lobes);
    const Vec3 i = by_facets ? reflect(o, facets_.sample_visible(o, u.x, u.y)) : cosine_hemisphere({u.x, u.y});
    if (i.z <= 0) return std::nullopt;
    const auto leaving = frame_.leave(i, side, transport, u.x);
    if (!leaving) return std::nullopt;
    const float pdf = leaving->share * density(o, i, lobes);
    if (!(pdf > 0)) return std::nullopt;
    return BsdfSample{leaving->wi, f(o, i, lobes) * (i.z / pdf), pdf, false};
  }

  float lobe_probability(const Vec3& wo, LobeSet lobes) const override {
    const float made_up = chance_of_made_up(frame_.local(wo, frame_.side(wo)), kFacets | kMadeUp);
    return (lobes & kFacets ? 1 - made_up : 0) + (lobes & kMadeUp ? made_up : 0);
  }

 private:
  FacetAlbedo albedo() const { return {facets_.alpha(), *tables_->even, tables_->brushed}; }

  /// Goes by white facets, so that metals of all colours choose alike.
  float chance_of_made_up(const Vec3& o, LobeSet lobes) const {
    constexpr float kLeast = 1e-4f;  // where the tables round the loss to nothing
    if (tables_ == nullptr || !(lobes & kMadeUp)) return 0;
    return lobes & kFacets ? std::clamp(1 - albedo().of(o), kLeast, 1 - kLeast) : 1;
  }

  Spectrum f(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    Spectrum sum;
    if (lobes & kFacets) {
      const Vec3 m = normalize(o + i);
      sum += fresnel_conductor(dot(o, m), index_.eta, index_.k) * facets_.reflection(o, i, m);
    }
    if (tables_ != nullptr && (lobes & kMadeUp)) {
      const FacetAlbedo white = albedo();
      const float lost = made_up(1 - white.of(o), 1 - white.of(i), 1 - white.mean());
      const float sure = 1 - kUnsureIfBrushed * white.narrowness();
      sum += after_more_reflections(mean_fresnel_conductor(index_.eta, index_.k), white.mean()) * (lost * sure);
    }
    return sum;
  }

  float density(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    const float made_up = chance_of_made_up(o, lobes);
    const float facets = lobes & kFacets ? (1 - made_up) * facets_.reflection_density(o, normalize(o + i)) : 0;
    return facets + made_up * i.z / kPi;
  }

  ShadingFrame frame_;
  Ggx facets_;
  MetalIndex index_;
  const MetalTables* tables_;
};

class ConductorMaterial final : public Material {
 public:
  ConductorMaterial(ParamReader& reader, const MaterialContext& context)
      : roughness_(reader, context), metal_(reader, context), makes_up_(read_energy_compensation(reader, context)) {}

  /// Call this after the parameters have been checked.
  void make_tables() {
    if (!makes_up_ || roughness_.is_smooth()) return;
    tables_.even = &even_metal();
    if (!roughness_.is_even()) tables_.brushed = &brushed_metal();
  }

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const ShadingFrame frame(point);
    const Vec2 alpha = roughness_.alpha(point);
    if (Ggx::is_smooth(alpha)) return slot.emplace<SmoothConductor>(frame, metal_.index(point));
    return slot.emplace<RoughConductor>(frame, Ggx(alpha), metal_.index(point), makes_up_ ? &tables_ : nullptr);
  }

 private:
  Roughness roughness_;
  MetalLook metal_;
  bool makes_up_;
  MetalTables tables_;
};

}  // namespace

std::unique_ptr<Material> make_conductor(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<ConductorMaterial>(reader, context);
  reader.finish();
  material->make_tables();
  return material;
}

}  // namespace dspm
