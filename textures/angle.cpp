// The angle of a direction that a picture of colours holds, as glTF's pictures of brushed metal do.
//
//   Texture "brushed" "float" "angle" "texture tex" "directions" "float rotation" 30
//
//   | tex      | (1, .5, .5) | always spectrum: 2 red - 1 is along u, 2 green - 1 along v |
//   | rotation | 0           | degrees that are added                                     |
//
// In degrees, from u towards v. Directions are averaged before the angle is taken, so turns of 360 degrees leave no
// seam.
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

template <class T>
class AngleTexture final : public Texture<T> {
 public:
  AngleTexture(TexturePtr<Rgb> directions, float rotation) : directions_(std::move(directions)), rotation_(rotation) {}

  T evaluate(const TexturePoint& at) const override { return angle(directions_->evaluate(at)); }

  std::optional<T> constant() const override {
    const auto direction = directions_->constant();
    return direction ? std::optional<T>(angle(*direction)) : std::nullopt;
  }

 private:
  T angle(const Rgb& c) const { return T(rotation_ + rounded::atan2(2 * c.g - 1, 2 * c.r - 1) * 180 / kPi); }

  TexturePtr<Rgb> directions_;
  float rotation_;
};

}  // namespace

template <class T>
TexturePtr<T> make_angle(ParamReader& reader, const TextureContext& context) {
  const auto directions = reader.rgb_or_texture("tex", Rgb(1, 0.5f, 0.5f), SpectrumRole::albedo, "always spectrum");
  const float rotation = reader.number("rotation", 0, "degrees", "that are added");
  reader.finish();
  return std::make_shared<AngleTexture<T>>(texture_of(directions, context.textures, reader.diagnostics()), rotation);
}

template TexturePtr<float> make_angle<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_angle<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
