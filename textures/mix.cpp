// A blend of two textures.
//
//   Texture "worn" "spectrum" "mix" "texture tex1" "paint" "texture tex2" "steel" "texture amount" "scratches"
//
//   | tex1   | 0  | where amount is 0              |
//   | tex2   | 1  | where amount is 1              |
//   | amount | .5 | fraction of tex2; always float |
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/plain_part.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

template <class T>
class MixTexture final : public Texture<T> {
 public:
  MixTexture(TexturePtr<T> first, TexturePtr<T> second, TexturePtr<float> amount)
      : first_(std::move(first)),
        second_(std::move(second)),
        amount_(std::move(amount)),
        plain_first_(first_),
        plain_second_(second_),
        plain_amount_(amount_) {}

  T evaluate(const TexturePoint& at) const override { return value(Evaluate{at}); }
  Carried<T> carried(const TexturePoint& at) const override { return value(Carry{at}); }

  std::optional<T> constant() const override {
    const auto first = first_->constant(), second = second_->constant();
    const auto amount = amount_->constant();
    return first && second && amount ? std::optional<T>(mixed(*first, *second, *amount)) : std::nullopt;
  }
  /// Returns false if two factors vary: their product has another mean than the product of their means.
  bool averages() const override {
    const bool one_varies = amount_->constant() || (first_->constant() && second_->constant());
    return one_varies && first_->averages() && second_->averages() && amount_->averages();
  }
  std::optional<PlainTexture<T>> plain() const override {
    return if_sound(PlainTexture<T>(PlainMix<T>{plain_first_.get(), plain_second_.get(), plain_amount_.get()}));
  }

 private:
  template <class Look>
  auto value(const Look& look) const {
    return mixed(look(first_), look(second_), look(amount_));
  }

  TexturePtr<T> first_, second_;
  TexturePtr<float> amount_;
  PlainPart<T> plain_first_, plain_second_;
  PlainPart<float> plain_amount_;
};

}  // namespace

template <class T>
TexturePtr<T> make_mix(ParamReader& reader, const TextureContext& context) {
  const auto first = value_or_texture<T>(reader, "tex1", 0, "where amount is 0");
  const auto second = value_or_texture<T>(reader, "tex2", 1, "where amount is 1");
  const auto amount = reader.number_or_texture("amount", 0.5f, {}, "fraction of tex2");
  reader.finish();
  Diagnostics& diagnostics = reader.diagnostics();
  return std::make_shared<MixTexture<T>>(texture_of(first, context.textures, diagnostics),
                                         texture_of(second, context.textures, diagnostics),
                                         texture_of(amount, context.textures, diagnostics));
}

template TexturePtr<float> make_mix<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_mix<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
