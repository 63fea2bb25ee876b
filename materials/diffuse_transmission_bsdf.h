// The scattering of what is matte on both sides and lets light through.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_parameters.h"
#include "dspm/shapes/surface_geometry.h"
#include "dspm/textures/plain_value.h"

namespace dspm {

/// As in Diffuse, light is weighted by its cosine to ns, and photon paths sample around ng.
class DiffuseTransmission final : public PlainBsdf {
 public:
  constexpr DiffuseTransmission(const Vec3& ng, const Vec3& ns, const Spectrum& reflectance,
                                const Spectrum& transmittance)
      : ng_(ng), ns_(ns), reflected_(reflectance / kPi), transmitted_(transmittance / kPi) {
    const float r = max_component(reflectance), t = max_component(transmittance);
    chance_ = r + t > 0 ? r / (r + t) : 1;
  }

  constexpr LobeSet lobes(float) const { return 1; }
  constexpr Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
    if (!(lobes & 1) || !faces(transport == Transport::radiance ? wi : wo)) return {};
    return dot(wo, ng_) * dot(wi, ng_) > 0 ? reflected_ : transmitted_;
  }
  constexpr float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
    if (!(lobes & 1) || (transport == Transport::flux && !faces(wo))) return 0;
    const bool is_reflected = dot(wo, ng_) * dot(wi, ng_) > 0;
    const float side = dot(wi, ng_) > 0 ? 1.f : -1.f;
    return (is_reflected ? chance_ : 1 - chance_) * std::max(0.f, side * dot(wi, axis(transport))) / kPi;
  }
  constexpr std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const {
    if (!(lobes & 1) || (transport == Transport::flux && !faces(wo))) return std::nullopt;
    const bool is_reflected = u.z < chance_;
    const float side = (dot(wo, ng_) > 0) == is_reflected ? 1.f : -1.f;
    const Vec3 local = cosine_hemisphere({u.x, u.y}), wi = Basis::around(axis(transport) * side).to_world(local);
    if (local.z <= 0 || dot(wi, ng_) * side <= 0) return std::nullopt;
    const float cosines = axis(transport) == ns_ ? 1 : std::abs(dot(wi, ns_)) / local.z;
    const float chance = is_reflected ? chance_ : 1 - chance_;
    const Spectrum& f = is_reflected ? reflected_ : transmitted_;
    return BsdfSample{wi, f * (kPi * cosines / chance), chance * local.z / kPi, false};
  }
  constexpr float lobe_probability(const Vec3&, LobeSet lobes) const { return lobes & 1 ? 1.f : 0.f; }
  constexpr bool transmits(LobeSet lobes) const { return (lobes & 1) && !is_black(transmitted_); }
  constexpr std::optional<Spectrum> ratio_to(const DiffuseTransmission& o, LobeSet) const {
    const auto by_reflection = ratio(reflected_, o.reflected_), by_transmission = ratio(transmitted_, o.transmitted_);
    return by_reflection == by_transmission ? by_reflection : std::nullopt;
  }

 private:
  /// Returns whether both normals have `w` on the same side.
  constexpr bool faces(const Vec3& w) const { return dot(w, ng_) * dot(w, ns_) > 0; }
  constexpr const Vec3& axis(Transport transport) const { return transport == Transport::radiance ? ns_ : ng_; }

  Vec3 ng_, ns_;
  Spectrum reflected_, transmitted_;  // f
  float chance_ = 1;                  // the probability that reflection is sampled
};

struct PlainDiffuseTransmission {
  PlainValue<Rgb> reflectance, transmittance;
  float scale;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    reflectance.each_array(fn);
    transmittance.each_array(fn);
  }

  constexpr bool varies() const { return reflectance.varies() || transmittance.varies(); }
  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const Fn& fn) const {
    const PlainPlace place = place_of(point);
    const Spectrum reflected = clamped_albedo(reflectance.at(place) * scale),
                   transmitted = clamped_albedo(transmittance.at(place) * scale);
    const Spectrum share = map(reflected + transmitted, [](float sum) { return 1 / std::max(1.f, sum); });
    return fn(DiffuseTransmission(point.ng, point.ns, reflected * share, transmitted * share));
  }
};

}  // namespace dspm
