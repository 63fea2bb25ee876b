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
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/mapping.h"
#include "dspm/textures/noise.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

constexpr float kRadius = 0.35f, kMostShift = 0.5f - kRadius;

/// Squares are centred on points with whole coordinates.
bool in_dot(Vec2 st) {
  const Vec2 square{std::floor(st.x + 0.5f), std::floor(st.y + 0.5f)};
  const auto random = [&](float x, float y) { return noise({square.x + x, square.y + y, 0.5f}); };
  if (!(random(0.5f, 0.5f) > 0)) return false;
  const Vec2 shift{kMostShift * random(1.5f, 2.8f), kMostShift * random(4.5f, 9.8f)};
  const Vec2 off = st - (square + shift);
  return off.x * off.x + off.y * off.y < kRadius * kRadius;
}

template <class T>
class DotsTexture final : public Texture<T> {
 public:
  DotsTexture(TexturePtr<T> dots, TexturePtr<T> around, const TextureMapping& mapping)
      : dots_(std::move(dots)), around_(std::move(around)), mapping_(mapping) {}

  T evaluate(const TexturePoint& at) const override { return here(at)->evaluate(at); }
  Carried<T> carried(const TexturePoint& at) const override { return here(at)->carried(at); }

  std::optional<T> constant() const override {
    const auto dots = dots_->constant(), around = around_->constant();
    return dots && around && *dots == *around ? dots : std::nullopt;
  }

 private:
  const TexturePtr<T>& here(const TexturePoint& at) const { return in_dot(mapping_.at(at)) ? dots_ : around_; }

  TexturePtr<T> dots_, around_;
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
