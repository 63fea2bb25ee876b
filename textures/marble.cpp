// Layers of marble across y, distorted by noise: pale, with dark blue veins.
//
//   Texture "column" "spectrum" "marble" "float scale" 4 "float variation" .4
//
//   | octaves   | 8  | of the noise: how many sizes are added up         |
//   | roughness | .5 | of the noise: each octave's strength over the last |
//   | scale     | 1  | of the whole: layers repeat every 2 pi / scale in y, in the texture's own space |
//   | variation | .2 | how far noise moves the layers |
//
// The colours lie on a spline over the sine of the distorted height, with pbrt's control points. A texture of numbers
// is the mean of red, green and blue. [Perlin 1985; Pharr, Jakob, Humphreys, Physically Based Rendering, 3rd edition,
// 10.6.6]
#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/noise.h"
#include "dspm/textures/octaves.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

constexpr Rgb kPale{.58f, .58f, .6f}, kGrey{.5f, .5f, .5f}, kWarm{.6f, .59f, .58f}, kVein{.2f, .2f, .33f};
constexpr std::array<Rgb, 9> kSpline{kPale, kPale, kPale, kGrey, kWarm, kPale, kPale, kVein, kPale};
constexpr float kBrightness = 1.5f;

/// Evaluates the cubic Bezier curves whose control points are four successive ones of the spline, one curve after the
/// other as t runs from 0 to 1.
Rgb colour_at(float t) {
  constexpr int kCurves = static_cast<int>(kSpline.size()) - 3;
  const float along = t * static_cast<float>(kCurves);
  const int first = std::clamp(static_cast<int>(along), 0, kCurves - 1);
  const float x = along - static_cast<float>(first), y = 1 - x;
  const Rgb* const c = &kSpline[static_cast<std::size_t>(first)];
  return kBrightness * (c[0] * (y * y * y) + c[1] * (3 * x * y * y) + c[2] * (3 * x * x * y) + c[3] * (x * x * x));
}

template <class T>
class MarbleTexture final : public Texture<T> {
 public:
  MarbleTexture(const Octaves& octaves, float scale, float variation, const Transform& world_from_texture)
      : octaves_(octaves), scale_(scale), variation_(variation), world_from_texture_(world_from_texture) {}

  T evaluate(const TexturePoint& at) const override {
    const Vec3 own = world_from_texture_.inverse_point(at.p) * scale_;
    const float height = own.y + variation_ * fbm(own, octaves_);
    const Rgb colour = colour_at(std::isfinite(height) ? 0.5f + 0.5f * rounded::sin(height) : 0.f);
    if constexpr (std::is_same_v<T, float>)
      return (colour.r + colour.g + colour.b) / 3;
    else
      return colour;
  }

 private:
  Octaves octaves_;
  float scale_, variation_;
  Transform world_from_texture_;
};

}  // namespace

template <class T>
TexturePtr<T> make_marble(ParamReader& reader, const TextureContext& context) {
  const Octaves octaves = read_octaves(reader);
  const float scale = reader.number("scale", 1, {}, "of the whole: layers repeat every 2 pi / scale in y");
  const float variation = reader.number("variation", 0.2f, {}, "how far noise moves the layers");
  reader.finish();
  return std::make_shared<MarbleTexture<T>>(octaves, scale, variation, context.world_from_texture);
}

template TexturePtr<float> make_marble<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_marble<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
