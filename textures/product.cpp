// A texture times another of its kind: of two textures of colours, each component of its own.
//
//   Texture "tinted" "spectrum" "product" "texture tex1" "wood" "rgb tex2" [1 .8 .6]
//
//   | tex1, tex2 | 1 | the textures |
#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

template <class T>
class ProductTexture final : public Texture<T> {
 public:
  ProductTexture(TexturePtr<T> first, TexturePtr<T> second) : first_(std::move(first)), second_(std::move(second)) {}

  T evaluate(const TexturePoint& at) const override { return first_->evaluate(at) * second_->evaluate(at); }
  Carried<T> carried(const TexturePoint& at) const override { return first_->carried(at) * second_->carried(at); }

  std::optional<T> constant() const override {
    const auto first = first_->constant(), second = second_->constant();
    return first && second ? std::optional<T>(*first * *second) : std::nullopt;
  }
  bool averages() const override {
    return (first_->constant() || second_->constant()) && first_->averages() && second_->averages();
  }

 private:
  TexturePtr<T> first_, second_;
};

}  // namespace

template <class T>
TexturePtr<T> make_product(ParamReader& reader, const TextureContext& context) {
  const auto first = value_or_texture<T>(reader, "tex1", 1, "a texture");
  const auto second = value_or_texture<T>(reader, "tex2", 1, "what it is multiplied by");
  reader.finish();
  return std::make_shared<ProductTexture<T>>(texture_of(first, context.textures, reader.diagnostics()),
                                             texture_of(second, context.textures, reader.diagnostics()));
}

template TexturePtr<float> make_product<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_product<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
