// thindielectric: a pane of glass without thickness, such as a window or a bubble.
//
//   Material "thindielectric" "float eta" 1.5 "rgb tint" [.9 .6 .2]
//
//   eta    float or spectrum   1.5   index of refraction inside the pane over outside
//   tint   spectrum texture    1     what is left of white light that crosses the pane once, straight on
//
// Light goes straight through or is mirrored; both include the light reflected back and forth inside the pane.
// A spectrum for eta is averaged over the colours.
#include <optional>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_material.h"
#include "dspm/materials/thin_dielectric_bsdf.h"
#include "dspm/textures/plain_part.h"

namespace dspm {
namespace {

class ThinDielectricMaterial final : public Material {
 public:
  ThinDielectricMaterial(float eta, TexturePtr<Rgb> tint) : eta_(eta), tint_(std::move(tint)), plain_tint_(tint_) {}
  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return PlainThinDielectric{eta_, {tint_->carried(texture_point(point))}}.with_bsdf(point, IntoSlot{slot});
  }

 private:
  std::optional<PlainMaterial> plain_look(const Palette& palette) const override {
    const auto tint = plain_tint_.value(palette);
    return tint ? std::optional<PlainMaterial>(PlainThinDielectric{eta_, *tint}) : std::nullopt;
  }

  float eta_;
  TexturePtr<Rgb> tint_;
  PlainPart<Rgb> plain_tint_;
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
