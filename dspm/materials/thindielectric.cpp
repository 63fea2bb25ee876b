// thindielectric: a pane of glass without thickness, such as a window or a bubble.
//
//   Material "thindielectric" "float eta" 1.5
//
//   eta   float or spectrum   1.5   index of refraction inside the pane over outside
//
// Light goes straight through or is mirrored; both include the light reflected back and forth inside the pane:
// R' = R + T^2 R + T^2 R^3 + ... = R + T^2 R / (1 - R^2). A spectrum for eta is averaged over the colours.
#include "dspm/colour/rgb.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/interface.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"

namespace dspm {
namespace {

float pane_reflectance(float cos_o, float eta) {
  const float r = fresnel_dielectric(cos_o, eta);
  return r < 1 ? r + (1 - r) * (1 - r) * r / (1 - r * r) : 1;
}

class ThinDielectric final : public Bsdf {
 public:
  ThinDielectric(const ShadingFrame& frame, float eta) : frame_(frame), eta_(eta) {}

  LobeSet lobes(float least_alpha) const override { return least_alpha <= 0 ? kBothLobes : 0; }
  Rgb evaluate(const Vec3&, const Vec3&, Transport, LobeSet) const override { return {}; }
  float pdf_w(const Vec3&, const Vec3&, Transport, LobeSet) const override { return 0; }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    const Vec3 o = frame_.local(wo, side);
    if (!(lobes & kBothLobes) || o.z <= 0) return std::nullopt;
    const float reflectance = pane_reflectance(o.z, eta_), chance = chance_of_reflection(reflectance, lobes);
    const bool reflected = u.z < chance;
    const float weight = reflected ? reflectance / chance : (1 - reflectance) / (1 - chance);
    const std::optional<Vec3> wi = reflected ? frame_.leave({-o.x, -o.y, o.z}, side) : -wo;
    if (!wi || weight == 0) return std::nullopt;
    return BsdfSample{*wi, Rgb(weight), 0, true};
  }

  float lobe_probability(const Vec3& wo, LobeSet lobes) const override {
    return share_of(pane_reflectance(std::max(0.f, frame_.local(wo, frame_.side(wo)).z), eta_), lobes);
  }

 private:
  ShadingFrame frame_;
  float eta_;
};

class ThinDielectricMaterial final : public Material {
 public:
  explicit ThinDielectricMaterial(float eta) : eta_(eta) {}
  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return slot.emplace<ThinDielectric>(ShadingFrame(point), eta_);
  }

 private:
  float eta_;
};

}  // namespace

std::unique_ptr<Material> make_thindielectric(ParamReader& reader, const MaterialContext&) {
  const float eta = read_eta(reader);
  reader.finish();
  return std::make_unique<ThinDielectricMaterial>(eta);
}

}  // namespace dspm
