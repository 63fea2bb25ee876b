// The scattering of matte surfaces: the same radiance in all directions.
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

/// Light is weighted by its cosine to ns and leaves to the whole of its side of ng. So photon paths sample around ng: a
/// lobe around ns would send nothing to directions that ns does not face.
class Diffuse final : public PlainBsdf {
 public:
  constexpr Diffuse(const Vec3& ng, const Vec3& ns, const Spectrum& f) : ng_(ng), ns_(ns), f_(f) {}

  constexpr LobeSet lobes(float) const { return 1; }
  constexpr Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
    const bool one_side = dot(wo, ng_) * dot(wi, ng_) > 0;
    return (lobes & 1) && one_side && faces(transport == Transport::radiance ? wi : wo) ? f_ : Spectrum(0);
  }
  constexpr float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
    const float side = dot(wo, ng_);
    if (!(lobes & 1) || !(side * dot(wi, ng_) > 0) || (transport == Transport::flux && !faces(wo))) return 0;
    return std::max(0.f, std::copysign(1.f, side) * dot(wi, axis(transport))) / kPi;
  }
  constexpr std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const {
    if (!(lobes & 1) || (transport == Transport::flux && !faces(wo))) return std::nullopt;
    const float side = dot(wo, ng_) > 0 ? 1.f : -1.f;
    const Vec3 local = cosine_hemisphere({u.x, u.y}), wi = Basis::around(axis(transport) * side).to_world(local);
    if (local.z <= 0 || dot(wi, ng_) * side <= 0) return std::nullopt;
    const float cosines = axis(transport) == ns_ ? 1 : std::abs(dot(wi, ns_)) / local.z;
    return BsdfSample{wi, f_ * (kPi * cosines), local.z / kPi, false};
  }
  constexpr float lobe_probability(const Vec3&, LobeSet lobes) const { return lobes & 1 ? 1.f : 0.f; }
  constexpr std::optional<Spectrum> lambertian(LobeSet lobes) const { return lobes & 1 ? f_ : Spectrum(0); }

 private:
  /// Returns whether both normals have `w` on the same side.
  constexpr bool faces(const Vec3& w) const { return dot(w, ng_) * dot(w, ns_) > 0; }
  constexpr const Vec3& axis(Transport transport) const { return transport == Transport::radiance ? ns_ : ng_; }

  Vec3 ng_, ns_;
  Spectrum f_;
};

struct PlainDiffuse {
  PlainValue<Rgb> reflectance;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    reflectance.each_array(fn);
  }

  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const Fn& fn) const {
    return fn(Diffuse(point.ng, point.ns, clamped_albedo(reflectance.at(place_of(point))) / kPi));
  }
};

}  // namespace dspm
