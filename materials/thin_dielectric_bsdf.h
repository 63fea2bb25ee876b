// The scattering of a pane of glass without thickness. With the light reflected back and forth inside the pane and
// t = tint^(1 / cos) for the angle inside,
//   R' = R + T^2 t^2 R + T^2 t^4 R^3 + ... = R + T^2 t^2 R / (1 - t^2 R^2),   T' = T^2 t / (1 - t^2 R^2).
#pragma once

#include <cmath>
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/interface.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_parameters.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/shapes/surface_geometry.h"
#include "dspm/textures/plain_value.h"

namespace dspm {

class ThinDielectric final : public PlainBsdf {
 public:
  constexpr ThinDielectric(const ShadingFrame& frame, float eta, const Spectrum& tint)
      : frame_(frame), eta_(eta), tint_(tint) {}

  constexpr LobeSet lobes(float least_alpha) const { return least_alpha <= 0 ? kBothLobes : 0; }
  constexpr Spectrum evaluate(const Vec3&, const Vec3&, Transport, LobeSet) const { return {}; }
  constexpr float pdf_w(const Vec3&, const Vec3&, Transport, LobeSet) const { return 0; }

  constexpr std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const {
    const float side = frame_.side(wo);
    const float cos_o = std::abs(frame_.local(wo, side).z);
    if (!(lobes & kBothLobes) || cos_o == 0) return std::nullopt;
    const float chance = chance_of_reflection(share_of_reflection(cos_o), lobes);
    if (u.z >= chance) {  // straight on, whatever the normals say
      const Spectrum weight = passed(cos_o) / (1 - chance);
      return is_black(weight) ? std::nullopt : std::optional<BsdfSample>(BsdfSample{-wo, weight, 0, true});
    }
    const auto o = frame_.arrive(wo, side, transport);
    if (!o) return std::nullopt;
    const auto leaving = frame_.leave({-o->x, -o->y, o->z}, side, transport, u.x);
    if (!leaving) return std::nullopt;
    return BsdfSample{leaving->wi, mirrored(cos_o) / (chance * leaving->share), 0, true};
  }

  constexpr float lobe_probability(const Vec3& wo, LobeSet lobes) const {
    return share_of(share_of_reflection(std::abs(frame_.local(wo, frame_.side(wo)).z)), lobes);
  }

 private:
  /// Goes by a clear pane, so that panes of all colours choose alike.
  constexpr float share_of_reflection(float cos_o) const {
    const float r = fresnel_dielectric(cos_o, eta_);
    return r < 1 ? r + (1 - r) * (1 - r) * r / (1 - r * r) : 1;
  }
  constexpr Spectrum mirrored(float cos_o) const {
    const float r = fresnel_dielectric(cos_o, eta_);
    return for_each_colour(cos_o, r, [&](float t) { return r + (1 - r) * (1 - r) * t * t * r / (1 - t * t * r * r); });
  }
  constexpr Spectrum passed(float cos_o) const {
    const float r = fresnel_dielectric(cos_o, eta_);
    return for_each_colour(cos_o, r, [&](float t) { return (1 - r) * (1 - r) * t / (1 - t * t * r * r); });
  }
  template <class Fn>
  constexpr Spectrum for_each_colour(float cos_o, float r, Fn&& fn) const {
    if (r >= 1) return Spectrum(fn(0.f));
    const float cos_inside = rounded::sqrt(1 - (1 - cos_o * cos_o) / (eta_ * eta_));
    const auto crossed = [&](float tint) { return tint == 1 ? 1 : rounded::pow(tint, 1 / cos_inside); };
    return map(tint_, [&](float tint) { return fn(crossed(tint)); });
  }

  ShadingFrame frame_;
  float eta_;
  Spectrum tint_;
};

struct PlainThinDielectric {
  float eta;
  PlainValue<Rgb> tint;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    tint.each_array(fn);
  }

  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const Fn& fn) const {
    return fn(ThinDielectric(ShadingFrame(point), eta, clamped_albedo(tint.at(place_of(point)))));
  }
};

}  // namespace dspm
