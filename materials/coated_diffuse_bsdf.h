// The scattering of a diffuse base under a clear coat, smooth or of rough facets.
#pragma once

#include <algorithm>
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/boundary_tables.h"
#include "dspm/materials/brushed_albedo.h"
#include "dspm/materials/coat.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/interface.h"
#include "dspm/materials/made_up.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_parameters.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/shapes/surface_geometry.h"
#include "dspm/textures/plain_value.h"

namespace dspm {

/// What all points of a coat over a diffuse base share: the way of light to the base and back. The tables must outlive it.
struct CoatToBase {
  Coat coat;
  const BoundaryTables* facets = nullptr;  // null: the coat lets light in as if it were smooth
  const BrushedAlbedo* brushed = nullptr;  // of what it mirrors; null: equally rough in both directions
  bool loses = false;                      // what meets two facets, and in its thickness, as pbrt's does

  /// Returns the share of light from outside that reaches the base, or of diffuse light from the base that leaves this
  /// way.
  constexpr float let_through(const Vec3& w, bool smooth, const Ggx& rough) const {
    if (!loses) return 1 - (smooth || facets == nullptr ? coat.mirrored(w.z) : mirrored(rough).of(w));
    const float sin2_inside = (1 - w.z * w.z) / (coat.eta * coat.eta);
    if (sin2_inside >= 1) return 0;
    const float passed = smooth ? 1 - coat.mirrored(w.z) : facets->outside.refracted(w.z, Coat::mean_alpha(rough));
    return passed * coat.left(rounded::sqrt(1 - sin2_inside));
  }
  /// Returns the albedo of what its facets mirror.
  constexpr FacetAlbedo mirrored(const Ggx& rough) const { return {rough.alpha(), facets->outside.reflected, brushed}; }

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(facets, 1);
    fn(brushed, 1);
  }
};

class CoatedDiffuse final : public PlainBsdf {
 public:
  /// The coat mirrors; the base gets the light that the coat transmits.
  static constexpr LobeSet kCoat = kReflection, kBase = kTransmission;

  /// `base` is the factor of what the coat lets through for wo and for wi.
  constexpr CoatedDiffuse(const ShadingFrame& frame, Vec2 alpha, const CoatToBase& coat, const Spectrum& base)
      : frame_(frame),
        facets_(alpha),
        base_weight_(weight_in_choice(kPi * coat.coat.eta * coat.coat.eta * max_component(base))),
        coat_(coat),
        base_(base),
        smooth_(Ggx::is_smooth(alpha) || coat.coat.eta == 1) {}

  constexpr LobeSet lobes(float least_alpha) const {
    const float coat_alpha = smooth_ ? 0 : facets_.least_alpha();
    return coat_alpha >= std::max(least_alpha, 0.f) ? kBothLobes : kBase;
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
    const bool nothing_mirrors = eta() == 1 && !(lobes & kBase);
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
      return BsdfSample{leaving->wi, Spectrum(fresnel_dielectric(o.z, eta()) / (chance * leaving->share)), 0, true};
    const float pdf = leaving->share * density(o, i, lobes);
    return BsdfSample{leaving->wi, f(o, i, lobes) * (i.z / pdf), pdf, false};
  }

  constexpr float lobe_probability(const Vec3& wo, LobeSet lobes) const {
    return share_of(share_of_coat(std::abs(frame_.local(wo, frame_.side(wo)).z)), lobes);
  }

  constexpr std::optional<Spectrum> ratio_to(const CoatedDiffuse& o, LobeSet lobes) const {
    if (eta() != o.eta() || ((lobes & kCoat) && !(smooth_ && o.smooth_)) || !lets_through_as(o)) return std::nullopt;
    return ratio(base_, o.base_);
  }

 private:
  /// Limits what a dark base takes from the coat: it must not take all paths. It goes in steps, so that finishes whose
  /// bases are about equally bright choose alike and stay one path.
  static constexpr float weight_in_choice(float reflectance) {
    return reflectance >= 1 / 4.f ? 1 : reflectance >= 1 / 16.f ? 1 / 4.f : 1 / 16.f;
  }

  constexpr bool lets_through_as(const CoatedDiffuse& o) const {
    if (coat_.loses != o.coat_.loses || coat_.coat.thickness != o.coat_.coat.thickness) return false;
    const bool either = coat_.facets != nullptr || o.coat_.facets != nullptr;
    return !either || (smooth_ && o.smooth_) || facets_.alpha() == o.facets_.alpha();
  }
  constexpr float let_through(const Vec3& w) const { return coat_.let_through(w, smooth_, facets_); }
  constexpr float eta() const { return coat_.coat.eta; }

  constexpr float share_of_coat(float cos_o) const {
    const float mirrored = fresnel_dielectric(cos_o, eta());
    return mirrored / (mirrored + (1 - mirrored) * base_weight_);
  }
  constexpr float chance_of_coat(const Vec3& o, LobeSet lobes) const {
    return chance_of_reflection(share_of_coat(o.z), lobes);
  }

  /// Returns f for directions above the surface, as does the density.
  constexpr Spectrum f(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    Spectrum sum;
    if (lobes & kBase) sum += base_ * (let_through(o) * let_through(i));
    if ((lobes & kCoat) && !smooth_) {
      const Vec3 m = normalize(o + i);
      sum += Spectrum(coat_.coat.mirrored_by_facet(dot(o, m), o.z, i.z) * facets_.reflection(o, i, m));
    }
    return sum;
  }

  constexpr float density(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    const float coat = chance_of_coat(o, lobes);
    float sum = 0;
    if (lobes & kBase) sum += (1 - coat) * i.z / kPi;
    if ((lobes & kCoat) && !smooth_) sum += coat * facets_.reflection_density(o, normalize(o + i));
    return sum;
  }

  ShadingFrame frame_;
  Ggx facets_;
  float base_weight_;  // of the transmitted light, when a lobe is chosen
  CoatToBase coat_;
  Spectrum base_;
  bool smooth_;
};

/// What the base scatters to and fro under the coat.
struct CoatedBase {
  CoatToBase way;
  float let_in = 0;           // the fraction of diffuse light that enters the coat, if it is smooth
  int visits = 0;             // of the base, at most, if the coat loses light
  float mirrored_inside = 0;  // the fraction of diffuse light that a smooth coat sends back to the base
  float left_inside = 1;      // of it, what the way through the coat leaves

  /// Returns the factor of what the coat lets through, if the base alone has the albedo a.
  constexpr Spectrum factor(const Spectrum& a, Vec2 alpha) const {
    return way.loses ? walked(a, alpha) : all(a, alpha);
  }

 private:
  /// Returns the base's factor over eta^2, which is 0 if no light gets in. By reciprocity, 1 - F_in is let_in / eta^2.
  constexpr Spectrum all(const Spectrum& a, Vec2 alpha) const {
    const bool smooth = Ggx::is_smooth(alpha) || way.facets == nullptr;
    const float eta = way.coat.eta, into = smooth ? let_in : 1 - way.mirrored(Ggx(alpha)).mean();
    Spectrum base;
    for (int c = 0; c < 3; ++c) {
      const float remaining = eta * eta * (1 - a[c]) + a[c] * into;
      base[c] = remaining > 0 ? a[c] / (kPi * remaining) : 0;
    }
    return base;
  }
  constexpr Spectrum walked(const Spectrum& a, Vec2 alpha) const {
    const float eta = way.coat.eta;
    const bool smooth = Ggx::is_smooth(alpha) || eta == 1;
    const float back =
        smooth ? mirrored_inside : left_inside * way.facets->inside.reflected.mean(Coat::mean_alpha(Ggx(alpha)));
    Spectrum base;
    for (int c = 0; c < 3; ++c) {
      const float again = a[c] * back;
      const float sum =
          again < 1 ? (1 - rounded::pow(again, static_cast<float>(visits))) / (1 - again) : static_cast<float>(visits);
      base[c] = a[c] * sum / (kPi * eta * eta);
    }
    return base;
  }
};

/// The tables must outlive it.
struct PlainCoatedDiffuse {
  PlainRoughness roughness;
  PlainValue<Rgb> reflectance;
  CoatedBase base;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    roughness.each_array(fn);
    reflectance.each_array(fn);
    base.way.each_array(fn);
  }

  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const Fn& fn) const {
    const PlainPlace place = place_of(point);
    const Vec2 alpha = roughness.alpha(place);
    const Spectrum a = clamped_albedo(reflectance.at(place));
    return fn(CoatedDiffuse(ShadingFrame(point), alpha, base.way, base.factor(a, alpha)));
  }
};

}  // namespace dspm
