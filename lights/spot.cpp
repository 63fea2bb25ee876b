// LightSource "spot" "rgb I" [100 100 100] "point3 from" [0 3 0] "point3 to" [0 0 0] "float coneangle" 20
//
// A point light that shines into a cone. Off the axis by less than coneangle - conedeltaangle it has its full
// intensity; from there it falls to 0 at coneangle as 3 x^2 - 2 x^3, x linear in the cosine. Photons follow the falloff
// exactly, so all carry the same flux; if the cone changes, those of the widest one carry weights.
//
// | parameter      | default | meaning |
// | -------------- | ------- | ------- |
// | I              | 1       | radiant intensity (W/sr) on the axis |
// | from           | 0 0 0   | its position, in light space |
// | to             | 0 0 1   | a point on the axis, in light space |
// | coneangle      | 30      | degrees between the axis and darkness |
// | conedeltaangle | 5       | degrees of the falloff, within coneangle |
// | scale          | 1       | multiplies I |
// | power          | -1      | if above 0: I is scaled to this many lumens, as if its luminance were 1 |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 12.2.1]
#include <algorithm>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/lights/aim.h"
#include "dspm/lights/emitter_light.h"
#include "dspm/lights/light.h"
#include "dspm/lights/spot_emitter.h"
#include "dspm/lights/strength.h"

namespace dspm {
namespace {

// 1 - cos: exact for narrow cones, where the cosine is not.
float versine(float degrees) {
  const double s = std::sin(static_cast<double>(degrees) / 360 * static_cast<double>(kPi));
  return static_cast<float>(2 * s * s);
}

class Spot final : public EmitterLight<SpotEmitter> {
 public:
  using EmitterLight::EmitterLight;

  std::optional<LightBounds> bounds() const override {
    const SpotEmitter& e = emitter();
    const float spread = rounded::acos(std::clamp(1 - e.inner, -1.f, 1.f));
    return LightBounds{{e.p, e.p}, e.basis.z, spread, rounded::acos(std::clamp(1 - e.outer, -1.f, 1.f)) - spread};
  }

  std::optional<Rgb> ratio_to(const Light& other) const override {
    const auto* o = dynamic_cast<const Spot*>(&other);
    if (o == nullptr || !shares_axis(*o) || emitter().inner != o->emitter().inner ||
        emitter().outer != o->emitter().outer)
      return std::nullopt;
    return ratio(emitter().intensity, o->emitter().intensity);
  }

  // A cone within the other. With these falloffs, no weight then exceeds the ratio of the cones.
  bool starts_like(const Light& other) const override {
    const auto* o = dynamic_cast<const Spot*>(&other);
    if (o == nullptr || !shares_axis(*o)) return false;
    const SpotEmitter &mine = emitter(), &theirs = o->emitter();
    return mine.inner <= theirs.inner && mine.outer <= theirs.outer &&
           theirs.inner + theirs.outer <= kMostWeight * (mine.inner + mine.outer) &&
           ratio(mine.intensity, theirs.intensity);
  }
  Rgb ratio_along(const Light& other, const Ray& start) const override {
    const SpotEmitter &mine = emitter(), &theirs = static_cast<const Spot&>(other).emitter();
    const float share = theirs.falloff(start.direction);
    return share > 0 ? *ratio(mine.intensity, theirs.intensity) * (mine.falloff(start.direction) / share) : Rgb();
  }

 private:
  bool shares_axis(const Spot& o) const {
    return emitter().p == o.emitter().p && emitter().basis.z == o.emitter().basis.z;
  }
};

struct Cone {
  float angle, delta;
};

Cone read_cone(ParamReader& reader) {
  Cone cone{reader.number("coneangle", 30, "degrees", "between the axis and darkness"),
            reader.number("conedeltaangle", 5, "degrees", "of the falloff, within coneangle")};
  if (!(cone.angle > 0 && cone.angle <= 180)) {
    reader.error("coneangle", "parameter \"coneangle\" of " + reader.subject() + " must be above 0 and at most 180");
  } else if (!(cone.delta >= 0 && cone.delta <= cone.angle)) {
    reader.error("conedeltaangle", "parameter \"conedeltaangle\" of " + reader.subject() + " must lie in 0..coneangle");
  } else {
    return cone;
  }
  return {30, 5};
}

}  // namespace

std::unique_ptr<Light> make_spot(ParamReader& reader, const LightContext& context) {
  const Rgb intensity = reader.rgb("I", Rgb(1), SpectrumRole::illuminant, "radiant intensity on the axis");
  const Aim aim = read_aim(reader);
  const Cone cone = read_cone(reader);
  const Strength strength = read_power(reader);
  reader.finish();
  const float inner = versine(cone.angle - cone.delta), outer = versine(cone.angle);
  return std::make_unique<Spot>(SpotEmitter{context.to_world.point(aim.from),
                                            Basis::around(normalize(context.to_world.vector(aim.along))),
                                            intensity * strength.factor(kPi * (inner + outer)), inner, outer});
}

}  // namespace dspm
