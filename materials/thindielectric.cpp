// thindielectric: a pane of glass without thickness, such as a window or a bubble.
//
//   Material "thindielectric" "float eta" 1.5 "rgb tint" [.9 .6 .2]
//
//   eta    float or spectrum   1.5   index of refraction inside the pane over outside
//   tint   spectrum texture    1     what is left of white light that crosses the pane once, straight on
//
// Light goes straight through or is mirrored; both include the light reflected back and forth inside the pane. With
// t = tint^(1 / cos) for the angle inside,
//   R' = R + T^2 t^2 R + T^2 t^4 R^3 + ... = R + T^2 t^2 R / (1 - t^2 R^2),   T' = T^2 t / (1 - t^2 R^2).
// A spectrum for eta is averaged over the colours.
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/interface.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/shading_frame.h"

namespace dspm {
namespace {

class ThinDielectric final : public Bsdf {
 public:
  ThinDielectric(const ShadingFrame& frame, float eta, const Spectrum& tint) : frame_(frame), eta_(eta), tint_(tint) {}

  LobeSet lobes(float least_alpha) const override { return least_alpha <= 0 ? kBothLobes : 0; }
  Spectrum evaluate(const Vec3&, const Vec3&, Transport, LobeSet) const override { return {}; }
  float pdf_w(const Vec3&, const Vec3&, Transport, LobeSet) const override { return 0; }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    const float cos_o = std::abs(frame_.local(wo, side).z);
    if (!(lobes & kBothLobes) || cos_o == 0) return std::nullopt;
    const float chance = chance_of_reflection(share_of_reflection(cos_o), lobes);
    if (u.z >= chance) {  // straight on, whatever the normals say
      const Spectrum weight = passed(cos_o) / (1 - chance);
      return is_black(weight) ? std::nullopt : std::optional(BsdfSample{-wo, weight, 0, true});
    }
    const auto o = frame_.arrive(wo, side, transport);
    if (!o) return std::nullopt;
    const auto leaving = frame_.leave({-o->x, -o->y, o->z}, side, transport, u.x);
    if (!leaving) return std::nullopt;
    return BsdfSample{leaving->wi, mirrored(cos_o) / (chance * leaving->share), 0, true};
  }

  float lobe_probability(const Vec3& wo, LobeSet lobes) const override {
    return share_of(share_of_reflection(std::abs(frame_.local(wo, frame_.side(wo)).z)), lobes);
  }

 private:
  /// Goes by a clear pane, so that panes of all colours choose alike.
  float share_of_reflection(float cos_o) const {
    const float r = fresnel_dielectric(cos_o, eta_);
    return r < 1 ? r + (1 - r) * (1 - r) * r / (1 - r * r) : 1;
  }
  Spectrum mirrored(float cos_o) const {
    const float r = fresnel_dielectric(cos_o, eta_);
    return for_each_colour(cos_o, r, [&](float t) { return r + (1 - r) * (1 - r) * t * t * r / (1 - t * t * r * r); });
  }
  Spectrum passed(float cos_o) const {
    const float r = fresnel_dielectric(cos_o, eta_);
    return for_each_colour(cos_o, r, [&](float t) { return (1 - r) * (1 - r) * t / (1 - t * t * r * r); });
  }
  template <class Fn>
  Spectrum for_each_colour(float cos_o, float r, Fn&& fn) const {
    if (r >= 1) return Spectrum(fn(0.f));
    const float cos_inside = std::sqrt(1 - (1 - cos_o * cos_o) / (eta_ * eta_));
    const auto crossed = [&](float tint) { return tint == 1 ? 1 : rounded::pow(tint, 1 / cos_inside); };
    return map(tint_, [&](float tint) { return fn(crossed(tint)); });
  }

  ShadingFrame frame_;
  float eta_;
  Spectrum tint_;
};

class ThinDielectricMaterial final : public Material {
 public:
  ThinDielectricMaterial(float eta, TexturePtr<Rgb> tint) : eta_(eta), tint_(std::move(tint)) {}
  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return slot.emplace<ThinDielectric>(ShadingFrame(point), eta_,
                                        clamped_albedo(tint_->carried(texture_point(point))));
  }

 private:
  float eta_;
  TexturePtr<Rgb> tint_;
};

}  // namespace

std::unique_ptr<Material> make_thindielectric(ParamReader& reader, const MaterialContext& context) {
  const float eta = read_eta(reader);
  const auto tint = reader.rgb_or_texture("tint", Rgb(1), SpectrumRole::albedo,
                                          "what is left of white light that crosses the pane once, straight on");
  reader.finish();
  return std::make_unique<ThinDielectricMaterial>(eta, texture_of(tint, context.textures, reader.diagnostics()));
}

}  // namespace dspm
