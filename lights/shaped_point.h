// A point light whose radiant intensity is a map over directions. `Map` has the sampling of EnvironmentMap: radiance(w)
// and pdf_w(w), sample(u), sample_numbers(w), fluence(), is_black() and ==. Directions are sampled in proportion to
// luminance.
#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/lights/light.h"
#include "dspm/lights/light_space.h"

namespace dspm {

template <class Map>
class ShapedPoint final : public Light {
 public:
  ShapedPoint(const Vec3& p, const LightSpace& space, Map map, const Rgb& intensity)
      : p_(p), space_(space), map_(std::move(map)), intensity_(intensity), power_(map_.fluence() * intensity) {}

  Rgb power() const override { return power_; }

  std::optional<LightBounds> bounds() const override { return LightBounds{{p_, p_}}; }

  std::optional<Emission> emit(Vec2, Vec2 u) const override {
    if (map_.is_black()) return std::nullopt;
    const auto s = map_.sample(u);
    const float pdf_w = s.pdf_w * space_.density_scale(s.direction);
    if (!(pdf_w > 0)) return std::nullopt;
    return Emission{{p_, space_.to_world(s.direction)}, s.radiance * intensity_ / pdf_w, pdf(pdf_w)};
  }

  EmissionPdf pdf_emit(const Ray& start, const Vec3&, int) const override {
    const Vec3 w = space_.to_light(start.direction);
    return pdf(map_.pdf_w(w) * space_.density_scale(w));
  }

  EmissionNumbers emission_numbers(const Ray& start, const Vec3&, int) const override {
    const Vec2 u = map_.sample_numbers(space_.to_light(start.direction));
    return {kAnyNumber, kAnyNumber, u.x, u.y};
  }

  std::optional<Illumination> illuminate(const Vec3& p, Vec2) const override {
    const Vec3 d = p_ - p;
    const float distance = length(d);
    if (!(distance > 0)) return std::nullopt;
    const Vec3 wi = d / distance;
    const Rgb intensity = map_.radiance(space_.to_light(-wi)) * intensity_;
    if (is_black(intensity)) return std::nullopt;
    return Illumination{wi, distance, intensity / (distance * distance), 0};
  }

  std::optional<Rgb> ratio_to(const Light& other) const override {
    const auto* o = dynamic_cast<const ShapedPoint*>(&other);
    if (o == nullptr || !(p_ == o->p_ && space_ == o->space_ && map_ == o->map_)) return std::nullopt;
    return ratio(intensity_, o->intensity_);
  }

 private:
  static EmissionPdf pdf(float pdf_w) { return {1, pdf_w, true, false}; }

  Vec3 p_;
  LightSpace space_;
  Map map_;
  Rgb intensity_;
  Rgb power_;  // an estimate if the transform stretches
};

}  // namespace dspm
