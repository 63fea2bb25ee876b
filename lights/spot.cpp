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
#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/lights/aim.h"
#include "dspm/lights/light.h"
#include "dspm/lights/strength.h"

namespace dspm {
namespace {

// 1 - cos: exact for narrow cones, where the cosine is not.
float versine(float degrees) {
  const double s = std::sin(static_cast<double>(degrees) / 360 * static_cast<double>(kPi));
  return static_cast<float>(2 * s * s);
}

// The x in [0, 1] with 2 x^3 - x^4 = u: inverts the integral of 2 (3 x^2 - 2 x^3).
float sample_falloff(float u) {
  if (!(u > 0)) return 0;
  // Newton's steps from above never overshoot, because the function is convex; the fifth no longer changes anything.
  float x = rounded::cbrt(u);
  for (int i = 0; i < 5; ++i) x -= (x * x * x * (2 - x) - u) / (x * x * (6 - 4 * x));
  return std::clamp(x, 0.f, 1.f);
}

class Spot final : public Light {
 public:
  /// Takes the cones as 1 - cos of their half angles.
  Spot(const Vec3& p, const Vec3& axis, const Rgb& intensity, float inner, float outer)
      : p_(p), basis_(Basis::around(axis)), intensity_(intensity), inner_(inner), outer_(outer) {}

  // The falloff has half the solid angle of its ring.
  Rgb power() const override { return kPi * (inner_ + outer_) * intensity_; }

  std::optional<LightBounds> bounds() const override {
    const float spread = rounded::acos(std::clamp(1 - inner_, -1.f, 1.f));
    return LightBounds{{p_, p_}, basis_.z, spread, rounded::acos(std::clamp(1 - outer_, -1.f, 1.f)) - spread};
  }

  std::optional<Emission> emit(Vec2, Vec2 u) const override {
    const float share = share_of_inner();
    const float versine =
        u.x < share ? inner_ * (u.x / share) : outer_ - (outer_ - inner_) * sample_falloff((u.x - share) / (1 - share));
    const Vec3 w = normalize(basis_.to_world(direction_at_height(1 - versine, versine * (2 - versine), u.y)));
    return Emission{{p_, w}, power(), pdf(w)};
  }

  EmissionPdf pdf_emit(const Ray& start, const Vec3&, int) const override { return pdf(start.direction); }

  EmissionNumbers emission_numbers(const Ray& start, const Vec3&, int) const override {
    const float versine = 0.5f * length2(start.direction - basis_.z), share = share_of_inner();
    const float x = (outer_ - versine) / (outer_ - inner_);
    const float place =
        versine < inner_ || inner_ == outer_ ? share * (versine / inner_) : share + (1 - share) * (x * x * x * (2 - x));
    return {kAnyNumber, kAnyNumber, std::clamp(place, 0.f, 1.f), turn_of(basis_.to_local(start.direction))};
  }

  std::optional<Illumination> illuminate(const Vec3& p, Vec2) const override {
    const Vec3 d = p_ - p;
    const float distance = length(d);
    if (!(distance > 0)) return std::nullopt;
    const Vec3 wi = d / distance;
    const float share = falloff(-wi);
    if (!(share > 0)) return std::nullopt;
    return Illumination{wi, distance, intensity_ * (share / (distance * distance)), 0};
  }

  std::optional<Rgb> ratio_to(const Light& other) const override {
    const auto* o = dynamic_cast<const Spot*>(&other);
    if (o == nullptr || !(p_ == o->p_ && basis_.z == o->basis_.z && inner_ == o->inner_ && outer_ == o->outer_))
      return std::nullopt;
    return ratio(intensity_, o->intensity_);
  }

  // A cone within the other. With these falloffs, no weight then exceeds the ratio of the cones.
  bool starts_like(const Light& other) const override {
    const auto* o = dynamic_cast<const Spot*>(&other);
    return o != nullptr && p_ == o->p_ && basis_.z == o->basis_.z && inner_ <= o->inner_ && outer_ <= o->outer_ &&
           o->inner_ + o->outer_ <= kMostWeight * (inner_ + outer_) && ratio(intensity_, o->intensity_);
  }
  Rgb ratio_along(const Light& other, const Ray& start) const override {
    const auto& o = static_cast<const Spot&>(other);
    const float theirs = o.falloff(start.direction);
    return theirs > 0 ? *ratio(intensity_, o.intensity_) * (falloff(start.direction) / theirs) : Rgb();
  }

 private:
  /// Returns the inner cone's share of the power.
  float share_of_inner() const { return 2 * inner_ / (inner_ + outer_); }

  EmissionPdf pdf(const Vec3& w) const { return {1, falloff(w) / (kPi * (inner_ + outer_)), true, false}; }

  float falloff(const Vec3& w) const {
    const float versine = 0.5f * length2(w - basis_.z);
    if (versine <= inner_) return 1;
    if (versine >= outer_) return 0;
    const float x = (outer_ - versine) / (outer_ - inner_);
    return x * x * (3 - 2 * x);
  }

  Vec3 p_;
  Basis basis_;
  Rgb intensity_;
  float inner_, outer_;
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
  return std::make_unique<Spot>(context.to_world.point(aim.from), normalize(context.to_world.vector(aim.along)),
                                intensity * strength.factor(kPi * (inner + outer)), inner, outer);
}

}  // namespace dspm
