// The scattering of a boundary of glass or a liquid, smooth or of rough facets.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/colour/wavelength.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/boundary_tables.h"
#include "dspm/materials/brushed_tables.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/interface.h"
#include "dspm/materials/made_up.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_parameters.h"
#include "dspm/materials/refractive_index.h"
#include "dspm/materials/rough_boundary.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

class SmoothDielectric final : public PlainBsdf {
 public:
  constexpr SmoothDielectric(const ShadingFrame& frame, const Refraction& refraction)
      : frame_(frame), refraction_(refraction) {}

  constexpr LobeSet lobes(float least_alpha) const { return least_alpha <= 0 ? kBothLobes : 0; }
  constexpr Spectrum evaluate(const Vec3&, const Vec3&, Transport, LobeSet) const { return {}; }
  constexpr float pdf_w(const Vec3&, const Vec3&, Transport, LobeSet) const { return 0; }

  constexpr std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const {
    const float side = frame_.side(wo), eta = refraction_.eta_from(side);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!(lobes & kBothLobes) || !arriving) return std::nullopt;
    const Vec3 o = *arriving;
    const float fresnel = fresnel_dielectric(o.z, eta), chance = chance_of_reflection(fresnel, lobes);
    const bool reflected = u.z < chance;
    const std::optional<Vec3> i = reflected ? Vec3{-o.x, -o.y, o.z} : refract(o, {0, 0, 1}, eta);
    const float mirrored = refraction_.disperses() ? fresnel_dielectric(o.z, refraction_.mirroring_eta(side)) : fresnel;
    const float weight = reflected ? mirrored / chance : (1 - fresnel) / (1 - chance) * transport_scale(transport, eta);
    if (!i || weight == 0) return std::nullopt;
    const auto leaving = frame_.leave(*i, side, transport, u.x);
    if (!leaving) return std::nullopt;
    BsdfSample sample{leaving->wi, Spectrum(weight / leaving->share), 0, true,
                      reflected ? 1 : transport_scale(transport, eta)};
    refraction_.apply_to(sample, !reflected, side);
    return sample;
  }

  constexpr float lobe_probability(const Vec3& wo, LobeSet lobes) const {
    const float side = frame_.side(wo), cos_o = std::abs(frame_.local(wo, side).z);
    const float fresnel = fresnel_dielectric(cos_o, refraction_.eta_from(side));
    return share_of(fresnel, lobes);
  }

 private:
  ShadingFrame frame_;
  Refraction refraction_;
};

/// The tables that all points of a rough body share, which must outlive its Bsdfs.
struct GlassTables {
  const BoundaryTables* even = nullptr;   // null: what meets a second facet is lost
  const BrushedGlass* brushed = nullptr;  // null: all facets are equally rough in both directions

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(even, 1);
    fn(brushed, 1);
  }
};

class RoughDielectric final : public PlainBsdf {
 public:
  static constexpr LobeSet kMadeUp = 4;

  constexpr RoughDielectric(const ShadingFrame& frame, const Ggx& facets, const Refraction& refraction,
                            const GlassTables& tables)
      : frame_(frame), facets_(facets), refraction_(refraction), tables_(tables) {}

  constexpr LobeSet lobes(float least_alpha) const {
    const LobeSet by_facets = facets_.least_alpha() >= least_alpha ? kBothLobes : 0;
    return static_cast<LobeSet>(by_facets | (tables_.even != nullptr ? kMadeUp : 0));
  }
  constexpr bool transmits(LobeSet lobes) const { return (lobes & kTransmission) != 0; }
  constexpr bool disperses(const Vec3& wo, const Vec3& wi) const {
    const float side = frame_.side(wo);
    return refraction_.disperses() && (side != frame_.side(wi) || refraction_.mirrors_by_wavelength(side));
  }

  constexpr Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
    const LocalPair w(frame_, wo, wi, transport);
    if (!w.valid) return {};
    if (w.reflection()) return refraction_.hue_of_mirrored(w.side) * f_above(w.wo, w.wi, w.side, lobes);
    const float eta = eta_from(w.side);
    const auto facet = lobes & kTransmission ? facet_between(w.wo, w.wi, eta) : std::nullopt;
    if (!facet) return {};
    return refraction_.hue_of_refracted() *
           ((1 - facet->fresnel) * refraction(facets_, w.wo, w.wi, *facet) * transport_scale(transport, eta));
  }

  constexpr float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
    const LocalPair w(frame_, wo, wi, transport);
    if (!w.valid) return 0;
    if (w.reflection()) return w.share * density_above(w.wo, w.wi, w.side, lobes);
    const auto facet = lobes & kTransmission ? facet_between(w.wo, w.wi, eta_from(w.side)) : std::nullopt;
    if (!facet) return 0;
    const float chance =
        (1 - chance_of_made_up(w.wo, w.side, lobes)) * (1 - chance_of_reflection(facet->fresnel, lobes));
    return w.share * chance * refraction_density(facets_, w.wo, *facet);
  }

  constexpr std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const {
    const float side = frame_.side(wo), eta = eta_from(side);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!(lobes & this->lobes(0)) || !arriving) return std::nullopt;
    const Vec3 o = *arriving;
    const float by_facets = 1 - chance_of_made_up(o, side, lobes);
    const Vec3 m = facets_.sample_visible(o, u.x, u.y);
    const float fresnel = fresnel_dielectric(dot(o, m), eta), mirror = chance_of_reflection(fresnel, lobes);
    const bool mirrored = u.z < mirror * by_facets, refracted = !mirrored && u.z < by_facets;
    const std::optional<Vec3> i = mirrored    ? reflect(o, m)
                                  : refracted ? refract(o, m, eta)
                                              : std::optional<Vec3>(cosine_hemisphere({u.x, u.y}));
    if (!i || (refracted ? i->z >= 0 : i->z <= 0)) return std::nullopt;
    const auto leaving = frame_.leave(*i, side, transport, u.x);
    if (!leaving) return std::nullopt;
    if (!refracted) {
      const float pdf = leaving->share * density_above(o, *i, side, lobes);
      if (!(pdf > 0)) return std::nullopt;
      BsdfSample sample{leaving->wi, Spectrum(f_above(o, *i, side, lobes) * i->z / pdf), pdf, false};
      refraction_.apply_to(sample, false, side);
      return sample;
    }
    const float chance = leaving->share * by_facets * (1 - mirror), scale = transport_scale(transport, eta);
    const float weight = (1 - fresnel) / chance * facets_.visible_after(o, *i);
    const float pdf = chance * facets_.visible_density(o, m) * solid_angle_ratio(o, *i, m, eta);
    BsdfSample sample{leaving->wi, Spectrum(weight * scale), pdf, false, scale};
    refraction_.apply_to(sample, true, side);
    return sample;
  }

  constexpr float lobe_probability(const Vec3& wo, LobeSet lobes) const;

 private:
  constexpr float eta_from(float side) const { return refraction_.eta_from(side); }
  /// Returns f for directions above the surface.
  constexpr float f_above(const Vec3& o, const Vec3& i, float side, LobeSet lobes) const {
    const Vec3 m = normalize(o + i);
    float sum = makes_up(lobes) ? f_made_up(o, i, side) : 0;
    if (lobes & kReflection)
      sum += fresnel_dielectric(dot(o, m), refraction_.mirroring_eta(side)) * facets_.reflection(o, i, m);
    return sum;
  }
  constexpr float density_above(const Vec3& o, const Vec3& i, float side, LobeSet lobes) const {
    const Vec3 m = normalize(o + i);
    const float made_up = chance_of_made_up(o, side, lobes);
    const float mirror = (1 - made_up) * chance_of_reflection(fresnel_dielectric(dot(o, m), eta_from(side)), lobes);
    return made_up * i.z / kPi + mirror * facets_.reflection_density(o, m);
  }

  constexpr bool makes_up(LobeSet lobes) const { return tables_.even != nullptr && (lobes & kMadeUp); }
  /// Returns the albedo of all that the facets send anywhere.
  constexpr FacetAlbedo albedo(float side) const {
    const BrushedGlass* const brushed = tables_.brushed;
    return {facets_.alpha(), (side > 0 ? tables_.even->outside : tables_.even->inside).reflected_or_refracted,
            brushed == nullptr ? nullptr
            : side > 0         ? &brushed->outside
                               : &brushed->inside};
  }
  constexpr float f_made_up(const Vec3& o, const Vec3& i, float side) const {
    const FacetAlbedo all = albedo(side);
    constexpr float kUnsureInside = 1.5f * kUnsureInsideIfBrushed;  // then nothing is gained at grazing angles, either
    const float unsure = side > 0 ? kUnsureIfBrushed : kUnsureInside, narrow = all.narrowness();
    // Of scratches that are a tenth as rough along themselves or less, tables know too little.
    const float sure = (1 - unsure * narrow) * std::min(1.f, 10 * (1 - narrow));
    return made_up(1 - all.of(o), 1 - all.of(i), 1 - all.mean()) * sure;
  }
  constexpr float chance_of_made_up(const Vec3& o, float side, LobeSet lobes) const {
    constexpr float kLeast = 1e-4f;  // where the tables round the loss to nothing
    if (!makes_up(lobes)) return 0;
    return lobes & kBothLobes ? std::clamp(1 - albedo(side).of(o), kLeast, 1 - kLeast) : 1;
  }

  ShadingFrame frame_;
  Ggx facets_;
  Refraction refraction_;
  GlassTables tables_;
};

/// Returns the probability of one of both lobes of the facets by their mean Fresnel reflectance as seen from wo, by a
/// midpoint rule (to about 1e-3). These lobes are equally rough, so no integrator asks for one of them alone in an
/// inner loop. (A lobe alone is sampled from all facets, not from those that would have chosen it.)
constexpr float RoughDielectric::lobe_probability(const Vec3& wo, LobeSet lobes) const {
  const float side = frame_.side(wo), eta = eta_from(side);
  Vec3 o = frame_.local(wo, side);
  o.z = std::max(std::abs(o.z), 1e-6f);
  const float made_up = chance_of_made_up(o, side, kBothLobes | kMadeUp);
  const float rest = lobes & kMadeUp ? made_up : 0;
  if (!(lobes & kBothLobes)) return rest;
  if ((lobes & kBothLobes) == kBothLobes) return rest + 1 - made_up;
  constexpr int kSteps = 16;
  float sum = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const float u = (static_cast<float>(i % kSteps) + 0.5f) / kSteps;
    const float v = (static_cast<float>(i / kSteps) + 0.5f) / kSteps;
    sum += fresnel_dielectric(dot(o, facets_.sample_visible(o, u, v)), eta);
  }
  return rest + (1 - made_up) * share_of(sum / (kSteps * kSteps), lobes);
}

/// Makes the roughness fade near an index of 1. Facets hardly turn light aside there, so what meets a second one is not
/// lost, as the model has it; and glass vanishes as its index approaches 1.
constexpr float share_of_roughness(float eta) {
  constexpr float kFull = 0.05f;
  return std::min(std::abs(eta - 1) / kFull, 1.f);
}

/// Glass and how it refracts light at a point. The tables must outlive it.
struct RefractingGlass {
  const PlainRoughness& roughness;
  Refraction refraction;
  GlassTables tables;

  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const Fn& fn) const {
    const ShadingFrame frame(point);
    const float share = std::min(share_of_roughness(refraction.mean_eta), share_of_roughness(refraction.eta));
    const Vec2 alpha = roughness.alpha(place_of(point)) * share;
    if (Ggx::is_smooth(alpha) || refraction.mean_eta == 1) return fn(SmoothDielectric(frame, refraction));
    return fn(RoughDielectric(frame, Ggx(alpha), refraction, tables));
  }
};

/// The tables and the indices must outlive it.
struct PlainDielectric {
  PlainRoughness roughness;
  PlainIndex index, outside;  // outside: around the body, over that for which its own is given
  GlassTables tables;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    roughness.each_array(fn);
    index.each_array(fn);
    outside.each_array(fn);
    tables.each_array(fn);
  }

  /// `wavelength` is that of the path that has met the point.
  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const HuedWavelength& wavelength,
                                     const Fn& fn) const {
    return RefractingGlass{roughness, Refraction(index, outside, wavelength), tables}.with_bsdf(point, fn);
  }
};

}  // namespace dspm
