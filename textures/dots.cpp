// Dots of one size, scattered without overlapping over the plane of the mapping: one in about half of the unit squares.
//
//   Texture "fabric" "spectrum" "dots" "float uscale" 12 "float vscale" 12 "rgb inside" [.1 .1 .5] "rgb outside" [1 0 0]
//
//   | inside  | 1 | between the dots |
//   | outside | 0 | in the dots      |
//   and the mapping's parameters, see mapping.h
//
// The names are exchanged, since pbrt's pictures have always had what "inside" says around the dots: its factory passes
// both in the order opposite to that of its texture. Noise decides which squares have a dot, and where in them. [Pharr,
// Jakob, Humphreys, Physically Based Rendering, 3rd edition, 10.6.2]
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/mapping.h"
#include "dspm/textures/plain_part.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

template <class T>
class DotsTexture final : public Texture<T> {
 public:
  DotsTexture(TexturePtr<T> dots, TexturePtr<T> around, const TextureMapping& mapping)
      : dots_(std::move(dots)),
        around_(std::move(around)),
        plain_dots_(dots_),
        plain_around_(around_),
        mapping_(mapping) {}

  T evaluate(const TexturePoint& at) const override { return here(at)->evaluate(at); }
  Carried<T> carried(const TexturePoint& at) const override { return here(at)->carried(at); }

  std::optional<T> constant() const override {
    const auto dots = dots_->constant(), around = around_->constant();
    return dots && around && *dots == *around ? dots : std::nullopt;
  }
  std::optional<PlainTexture<T>> plain() const override {
    const auto mapping = mapping_.plain();
    if (!mapping) return std::nullopt;
    return if_sound(PlainTexture<T>(PlainDots<T>{plain_dots_.get(), plain_around_.get(), *mapping}));
  }

 private:
  const TexturePtr<T>& here(const TexturePoint& at) const { return dots::contain(mapping_.at(at)) ? dots_ : around_; }

  TexturePtr<T> dots_, around_;
  PlainPart<T> plain_dots_, plain_around_;
  TextureMapping mapping_;
};

}  // namespace

template <class T>
TexturePtr<T> make_dots(ParamReader& reader, const TextureContext& context) {
  const auto around = value_or_texture<T>(reader, "inside", 1, "between the dots, as in pbrt's pictures");
  const auto dots = value_or_texture<T>(reader, "outside", 0, "in the dots, as in pbrt's pictures");
  const TextureMapping mapping = TextureMapping::read(reader, context.world_from_texture);
  reader.finish();
  Diagnostics& diagnostics = reader.diagnostics();
  return std::make_shared<DotsTexture<T>>(texture_of(dots, context.textures, diagnostics),
                                          texture_of(around, context.textures, diagnostics), mapping);
}

template TexturePtr<float> make_dots<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_dots<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
