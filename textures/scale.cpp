// A texture times a texture of numbers.
//
//   Texture "faded" "spectrum" "scale" "texture tex" "wood" "float scale" .5
//
//   | tex   | 1 | the texture to scale     |
//   | scale | 1 | the factor; always float |
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/plain_part.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

template <class T>
class ScaleTexture final : public Texture<T> {
 public:
  ScaleTexture(TexturePtr<T> texture, TexturePtr<float> scale)
      : texture_(std::move(texture)), scale_(std::move(scale)), plain_texture_(texture_), plain_scale_(scale_) {}

  T evaluate(const TexturePoint& at) const override { return texture_->evaluate(at) * scale_->evaluate(at); }
  Carried<T> carried(const TexturePoint& at) const override { return texture_->carried(at) * scale_->evaluate(at); }

  std::optional<T> constant() const override {
    const auto value = texture_->constant();
    const auto scale = scale_->constant();
    return value && scale ? std::optional<T>(*value * *scale) : std::nullopt;
  }
  bool averages() const override {
    return (texture_->constant() || scale_->constant()) && texture_->averages() && scale_->averages();
  }
  std::optional<PlainTexture<T>> plain() const override {
    return if_sound(PlainTexture<T>(PlainScale<T>{plain_texture_.get(), plain_scale_.get()}));
  }

 private:
  TexturePtr<T> texture_;
  TexturePtr<float> scale_;
  PlainPart<T> plain_texture_;
  PlainPart<float> plain_scale_;
};

}  // namespace

template <class T>
TexturePtr<T> make_scale(ParamReader& reader, const TextureContext& context) {
  const auto texture = value_or_texture<T>(reader, "tex", 1, "the texture to scale");
  const auto scale = reader.number_or_texture("scale", 1, {}, "the factor");
  reader.finish();
  Diagnostics& diagnostics = reader.diagnostics();
  return std::make_shared<ScaleTexture<T>>(texture_of(texture, context.textures, diagnostics),
                                           texture_of(scale, context.textures, diagnostics));
}

template TexturePtr<float> make_scale<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_scale<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
