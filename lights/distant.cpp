// LightSource "distant" "rgb L" [3 3 3] "point3 from" [1 2 0] "point3 to" [0 0 0]
//
// A sun: parallel light from infinitely far away. Photons start on a disk that covers the sphere around the scene. With
// an angle it is a disk in the sky, of even radiance: shadows are soft at their edges, and the camera and mirrors see
// it.
//
// | parameter   | default | meaning |
// | ----------- | ------- | ------- |
// | L           | 1       | irradiance (W/m^2) on a surface perpendicular to the light |
// | from, to    | 0 0 0, 0 0 1 | the light shines along to - from, in light space |
// | angle       | 0       | degrees across the disk, 0.01 to 180; 0: none, shadows are sharp. The real sun has 0.53 |
// | scale       | 1       | multiplies L |
// | illuminance | -1      | if above 0: L is scaled to give this many lux, as if its luminance were 1 |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 12.3]
#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/lights/aim.h"
#include "dspm/lights/distant_emitter.h"
#include "dspm/lights/emitter_light.h"
#include "dspm/lights/light.h"
#include "dspm/lights/scene_sphere.h"
#include "dspm/lights/strength.h"
#include "dspm/lights/sun_disk.h"

namespace dspm {
namespace {

class Distant final : public EmitterLight<DistantEmitter> {
 public:
  using EmitterLight::EmitterLight;

  std::optional<Rgb> ratio_to(const Light& other) const override {
    const auto* o = dynamic_cast<const Distant*>(&other);
    if (o == nullptr || !(emitter().wi == o->emitter().wi)) return std::nullopt;
    return ratio(emitter().irradiance, o->emitter().irradiance);
  }
};

float read_angle(ParamReader& reader) {
  const float angle = reader.number("angle", 0, "degrees", "across the sun's disk; 0: shadows are sharp");
  if (angle == 0 || (angle >= kLeastSunAngle && angle <= 180)) return angle;
  reader.error("angle", "parameter \"angle\" of " + reader.subject() + " must be 0, or lie in 0.01..180");
  return 0;
}

}  // namespace

std::unique_ptr<Light> make_distant(ParamReader& reader, const LightContext& context) {
  const Rgb irradiance =
      reader.rgb("L", Rgb(1), SpectrumRole::illuminant, "irradiance on a surface perpendicular to the light");
  const Aim aim = read_aim(reader);
  const float angle = read_angle(reader);
  const Rgb received = irradiance * read_illuminance(reader).factor(1);
  reader.finish();
  const Vec3 towards_light = -normalize(context.to_world.vector(aim.along));
  if (angle > 0) return make_sun_disk(context, towards_light, received, angle);
  const SceneSphere scene{context.scene_center, context.scene_radius};
  return std::make_unique<Distant>(DistantEmitter{scene, towards_light, received});
}

}  // namespace dspm
