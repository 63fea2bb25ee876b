// 1 where a texture of numbers reaches an edge: leaves cut out of a picture whose alpha is soft.
//
//   Texture "leaf" "float" "threshold" "texture tex" "outline" "float edge" .5
//
//   | tex  | 1  | always float |
//   | edge | .5 | 1 from there on, 0 below |
#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

template <class T>
class ThresholdTexture final : public Texture<T> {
 public:
  ThresholdTexture(TexturePtr<float> texture, float edge) : texture_(std::move(texture)), edge_(edge) {}

  T evaluate(const TexturePoint& at) const override { return cut(texture_->evaluate(at)); }

  std::optional<T> constant() const override {
    const auto value = texture_->constant();
    return value ? std::optional<T>(cut(*value)) : std::nullopt;
  }

 private:
  T cut(float value) const { return T(value >= edge_ ? 1.f : 0.f); }

  TexturePtr<float> texture_;
  float edge_;
};

}  // namespace

template <class T>
TexturePtr<T> make_threshold(ParamReader& reader, const TextureContext& context) {
  const auto texture = reader.number_or_texture("tex", 1, {}, "always float");
  const float edge = reader.number("edge", 0.5f, {}, "1 from there on, 0 below");
  reader.finish();
  return std::make_shared<ThresholdTexture<T>>(texture_of(texture, context.textures, reader.diagnostics()), edge);
}

template TexturePtr<float> make_threshold<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_threshold<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
