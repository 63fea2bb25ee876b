// The scattering of metal, smooth or of rough facets.
#pragma once

#include <algorithm>
#include <optional>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/made_up.h"
#include "dspm/materials/metal_tables.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_parameters.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

/// Metal of complex index of refraction eta + ik.
class SmoothConductor final : public PlainBsdf {
 public:
  constexpr SmoothConductor(const ShadingFrame& frame, const Spectrum& eta, const Spectrum& k)
      : frame_(frame), eta_(eta), k_(k) {}

  constexpr LobeSet lobes(float least_alpha) const { return least_alpha <= 0 ? 1 : 0; }
  constexpr Spectrum evaluate(const Vec3&, const Vec3&, Transport, LobeSet) const { return {}; }
  constexpr float pdf_w(const Vec3&, const Vec3&, Transport, LobeSet) const { return 0; }
  constexpr std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const {
    const float side = frame_.side(wo);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!(lobes & 1) || !arriving) return std::nullopt;
    const Vec3 o = *arriving;
    const auto leaving = frame_.leave({-o.x, -o.y, o.z}, side, transport, u.x);
    if (!leaving) return std::nullopt;
    return BsdfSample{leaving->wi, fresnel_conductor(o.z, eta_, k_) / leaving->share, 0, true};
  }
  constexpr float lobe_probability(const Vec3&, LobeSet lobes) const { return lobes & 1 ? 1.f : 0.f; }

 private:
  ShadingFrame frame_;
  Spectrum eta_, k_;
};

/// The same, of rough facets.
class RoughConductor final : public PlainBsdf {
 public:
  static constexpr LobeSet kFacets = 1, kMadeUp = 2;

  /// The tables must outlive it; without them, what meets a second facet is lost.
  constexpr RoughConductor(const ShadingFrame& frame, const Ggx& facets, const Spectrum& eta, const Spectrum& k,
                           const MetalTables& tables)
      : frame_(frame), facets_(facets), eta_(eta), k_(k), tables_(tables) {}

  constexpr LobeSet lobes(float least_alpha) const {
    const LobeSet mirrors = facets_.least_alpha() >= least_alpha ? kFacets : 0;
    return static_cast<LobeSet>(mirrors | (tables_.even != nullptr ? kMadeUp : 0));
  }

  constexpr Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
    const LocalPair w(frame_, wo, wi, transport);
    return w.reflection() ? f(w.wo, w.wi, lobes) : Spectrum(0);
  }

  constexpr float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
    const LocalPair w(frame_, wo, wi, transport);
    return w.reflection() ? w.share * density(w.wo, w.wi, lobes) : 0;
  }

  constexpr std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const {
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

  constexpr float lobe_probability(const Vec3& wo, LobeSet lobes) const {
    const float made_up = chance_of_made_up(frame_.local(wo, frame_.side(wo)), kFacets | kMadeUp);
    return (lobes & kFacets ? 1 - made_up : 0) + (lobes & kMadeUp ? made_up : 0);
  }

 private:
  constexpr FacetAlbedo albedo() const { return {facets_.alpha(), *tables_.even, tables_.brushed}; }

  /// Goes by white facets, so that metals of all colours choose alike.
  constexpr float chance_of_made_up(const Vec3& o, LobeSet lobes) const {
    constexpr float kLeast = 1e-4f;  // where the tables round the loss to nothing
    if (tables_.even == nullptr || !(lobes & kMadeUp)) return 0;
    return lobes & kFacets ? std::clamp(1 - albedo().of(o), kLeast, 1 - kLeast) : 1;
  }

  constexpr Spectrum f(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    Spectrum sum;
    if (lobes & kFacets) {
      const Vec3 m = normalize(o + i);
      sum += fresnel_conductor(dot(o, m), eta_, k_) * facets_.reflection(o, i, m);
    }
    if (tables_.even != nullptr && (lobes & kMadeUp)) {
      const FacetAlbedo white = albedo();
      const float lost = made_up(1 - white.of(o), 1 - white.of(i), 1 - white.mean());
      const float sure = 1 - kUnsureIfBrushed * white.narrowness();
      sum += after_more_reflections(mean_fresnel_conductor(eta_, k_), white.mean()) * (lost * sure);
    }
    return sum;
  }

  constexpr float density(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    const float made_up = chance_of_made_up(o, lobes);
    const float facets = lobes & kFacets ? (1 - made_up) * facets_.reflection_density(o, normalize(o + i)) : 0;
    return facets + made_up * i.z / kPi;
  }

  ShadingFrame frame_;
  Ggx facets_;
  Spectrum eta_, k_;
  MetalTables tables_;
};

/// The tables must outlive it.
struct PlainConductor {
  PlainRoughness roughness;
  PlainMetal metal;
  MetalTables tables;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    roughness.each_array(fn);
    metal.each_array(fn);
    tables.each_array(fn);
  }

  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const Fn& fn) const {
    const ShadingFrame frame(point);
    const Vec2 alpha = roughness.alpha(place_of(point));
    const auto [eta, k] = metal.index(place_of(point));
    if (Ggx::is_smooth(alpha)) return fn(SmoothConductor(frame, eta, k));
    return fn(RoughConductor(frame, Ggx(alpha), eta, k, tables));
  }
};

}  // namespace dspm
