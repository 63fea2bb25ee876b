// How a point shines equally in all directions.
#pragma once

#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/lights/emission.h"

namespace dspm {

struct PointEmitter {
  Vec3 p;
  Rgb intensity;

  constexpr Rgb power() const { return 4 * kPi * intensity; }

  constexpr Emission emit(Vec2, Vec2 u_direction) const {
    const Ray ray{p, uniform_sphere(u_direction)};
    return {ray, power(), pdf_emit(ray)};
  }

  constexpr EmissionPdf pdf_emit(const Ray&) const { return {1, kUniformSpherePdfW, true, false}; }

  constexpr EmissionNumbers emission_numbers(const Ray& start) const {
    const Vec2 u = uniform_sphere_numbers(start.direction);
    return {kAnyNumber, kAnyNumber, u.x, u.y};
  }

  constexpr std::optional<Illumination> illuminate(const Vec3& from) const {
    const Vec3 d = p - from;
    const float distance = length(d);
    if (!(distance > 0)) return std::nullopt;
    return Illumination{d / distance, distance, intensity / (distance * distance), 0};
  }
};

}  // namespace dspm
