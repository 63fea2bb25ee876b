// LightSource "point" "rgb I" [10 10 10] "point3 from" [0 2 0]
//
// Shines equally in all directions from a point.
//
// | parameter | default | meaning |
// | --------- | ------- | ------- |
// | I         | 1       | radiant intensity (W/sr) |
// | from      | 0 0 0   | its position, in light space |
// | scale     | 1       | multiplies I |
// | power     | -1      | if above 0: I is scaled to this many lumens, as if its luminance were 1 |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 12.2]
#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/lights/emitter_light.h"
#include "dspm/lights/light.h"
#include "dspm/lights/point_emitter.h"
#include "dspm/lights/strength.h"

namespace dspm {
namespace {

class Point final : public EmitterLight<PointEmitter> {
 public:
  using EmitterLight::EmitterLight;

  std::optional<LightBounds> bounds() const override { return LightBounds{{emitter().p, emitter().p}}; }

  std::optional<Rgb> ratio_to(const Light& other) const override {
    const auto* o = dynamic_cast<const Point*>(&other);
    if (o == nullptr || !(emitter().p == o->emitter().p)) return std::nullopt;
    return ratio(emitter().intensity, o->emitter().intensity);
  }
};

}  // namespace

std::unique_ptr<Light> make_point(ParamReader& reader, const LightContext& context) {
  const Rgb intensity = reader.rgb("I", Rgb(1), SpectrumRole::illuminant, "radiant intensity");
  const Vec3 from = reader.point("from", {}, "light space", "its position");
  const Strength strength = read_power(reader);
  reader.finish();
  return std::make_unique<Point>(PointEmitter{context.to_world.point(from), intensity * strength.factor(4 * kPi)});
}

}  // namespace dspm
