// diffusetransmission: matte on both sides and through, such as paper, a leaf or a lampshade of cloth.
//
//   Material "diffusetransmission" "rgb reflectance" [.3 .3 .25] "rgb transmittance" [.4 .35 .2]
//
//   reflectance     spectrum texture   0.25   fraction of the light that is reflected
//   transmittance   spectrum texture   0.25   fraction that leaves on the other side
//   scale           float              1      multiplies both
//
// Both are clamped to 0..1; where they add up to more than 1, they are scaled down to that.
#include <optional>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/diffuse_transmission_bsdf.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_material.h"
#include "dspm/textures/plain_part.h"

namespace dspm {
namespace {

class DiffuseTransmissionMaterial final : public Material {
 public:
  DiffuseTransmissionMaterial(TexturePtr<Rgb> reflectance, TexturePtr<Rgb> transmittance, float scale)
      : reflectance_(std::move(reflectance)),
        transmittance_(std::move(transmittance)),
        plain_reflectance_(reflectance_),
        plain_transmittance_(transmittance_),
        scale_(scale),
        is_linear_(reflectance_->averages() && transmittance_->averages() &&
                   scale_ * (most(*reflectance_) + most(*transmittance_)) <= 1) {}
  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const TexturePoint at = texture_point(point);
    return PlainDiffuseTransmission{{reflectance_->carried(at)}, {transmittance_->carried(at)}, scale_}.with_bsdf(
        point, IntoSlot{slot});
  }
  bool is_linear() const override { return is_linear_; }

 private:
  std::optional<PlainMaterial> plain_look(const Palette& palette) const override {
    const auto reflectance = plain_reflectance_.value(palette), transmittance = plain_transmittance_.value(palette);
    if (!reflectance || !transmittance) return std::nullopt;
    return PlainDiffuseTransmission{*reflectance, *transmittance, scale_};
  }

  /// Returns the most that a texture of albedos may have.
  static float most(const Texture<Rgb>& albedo) { return max_component(albedo.constant().value_or(Rgb(1))); }

  TexturePtr<Rgb> reflectance_, transmittance_;
  PlainPart<Rgb> plain_reflectance_, plain_transmittance_;
  float scale_;
  bool is_linear_;  // nothing is scaled down anywhere
};

}  // namespace

std::unique_ptr<Material> make_diffusetransmission(ParamReader& reader, const MaterialContext& context) {
  const auto reflectance = reader.rgb_or_texture("reflectance", Rgb(0.25f), SpectrumRole::albedo,
                                                 "fraction of the light that is reflected"),
             transmittance = reader.rgb_or_texture("transmittance", Rgb(0.25f), SpectrumRole::albedo,
                                                   "fraction of the light that leaves on the other side");
  const float scale = reader.number("scale", 1, "", "multiplies both");
  if (!(scale >= 0)) reader.error("scale", "\"scale\" must not be negative");
  reader.finish();
  return std::make_unique<DiffuseTransmissionMaterial>(
      texture_of(reflectance, context.textures, reader.diagnostics()),
      texture_of(transmittance, context.textures, reader.diagnostics()), scale);
}

}  // namespace dspm
