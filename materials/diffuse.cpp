// diffuse: matte, with equal radiance in all directions; both sides.
//
//   Material "diffuse" "rgb reflectance" [.7 .68 .65]
//
//   reflectance   spectrum texture   0.5   fraction of the light that is reflected, clamped to 0..1
//
// [Lambert 1760, Photometria]
#include <optional>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/diffuse_bsdf.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_material.h"
#include "dspm/textures/plain_part.h"

namespace dspm {
namespace {

class DiffuseMaterial final : public Material {
 public:
  explicit DiffuseMaterial(TexturePtr<Rgb> reflectance)
      : reflectance_(std::move(reflectance)), plain_(reflectance_), is_linear_(reflectance_->averages()) {}
  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return PlainDiffuse{{reflectance_->carried(texture_point(point))}}.with_bsdf(point, IntoSlot{slot});
  }
  bool is_linear() const override { return is_linear_; }

 private:
  std::optional<PlainMaterial> plain_look(const Palette& palette) const override {
    const auto reflectance = plain_.value(palette);
    return reflectance ? std::optional<PlainMaterial>(PlainDiffuse{*reflectance}) : std::nullopt;
  }

  TexturePtr<Rgb> reflectance_;
  PlainPart<Rgb> plain_;
  bool is_linear_;
};

}  // namespace

std::unique_ptr<Material> make_diffuse(ParamReader& reader, const MaterialContext& context) {
  const auto reflectance =
      reader.rgb_or_texture("reflectance", Rgb(0.5f), SpectrumRole::albedo, "fraction of the light that is reflected");
  reader.finish();
  return std::make_unique<DiffuseMaterial>(texture_of(reflectance, context.textures, reader.diagnostics()));
}

}  // namespace dspm
