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
#include "dspm/base/math/ray.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/lights/light.h"
#include "dspm/lights/strength.h"

namespace dspm {
namespace {

class Point final : public Light {
 public:
  Point(const Vec3& p, const Rgb& intensity) : p_(p), intensity_(intensity) {}

  Rgb power() const override { return 4 * kPi * intensity_; }

  std::optional<LightBounds> bounds() const override { return LightBounds{{p_, p_}}; }

  std::optional<Emission> emit(Vec2, Vec2 u_direction) const override {
    return Emission{{p_, uniform_sphere(u_direction)}, power(), pdf()};
  }

  EmissionPdf pdf_emit(const Ray&, const Vec3&, int) const override { return pdf(); }

  EmissionNumbers emission_numbers(const Ray& start, const Vec3&, int) const override {
    const Vec2 u = uniform_sphere_numbers(start.direction);
    return {kAnyNumber, kAnyNumber, u.x, u.y};
  }

  std::optional<Illumination> illuminate(const Vec3& p, Vec2) const override {
    const Vec3 d = p_ - p;
    const float distance = length(d);
    if (!(distance > 0)) return std::nullopt;
    return Illumination{d / distance, distance, intensity_ / (distance * distance), 0};
  }

  std::optional<Rgb> ratio_to(const Light& other) const override {
    const auto* o = dynamic_cast<const Point*>(&other);
    if (o == nullptr || !(p_ == o->p_)) return std::nullopt;
    return ratio(intensity_, o->intensity_);
  }

 private:
  static EmissionPdf pdf() { return {1, kUniformSpherePdfW, true, false}; }

  Vec3 p_;
  Rgb intensity_;
};

}  // namespace

std::unique_ptr<Light> make_point(ParamReader& reader, const LightContext& context) {
  const Rgb intensity = reader.rgb("I", Rgb(1), SpectrumRole::illuminant, "radiant intensity");
  const Vec3 from = reader.point("from", {}, "light space", "its position");
  const Strength strength = read_power(reader);
  reader.finish();
  return std::make_unique<Point>(context.to_world.point(from), intensity * strength.factor(4 * kPi));
}

}  // namespace dspm
