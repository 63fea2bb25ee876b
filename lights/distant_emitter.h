// How parallel light enters the sphere around the scene.
#pragma once

#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/lights/emission.h"
#include "dspm/lights/scene_sphere.h"

namespace dspm {

struct DistantEmitter {
  SceneSphere scene;
  Vec3 wi;  // towards the light
  Rgb irradiance;

  constexpr Rgb power() const { return irradiance * scene.disk_area(); }

  constexpr Emission emit(Vec2 u_position, Vec2) const {
    const Ray ray = scene.entering(wi, u_position);
    return {ray, power(), pdf_emit(ray)};
  }

  constexpr EmissionPdf pdf_emit(const Ray&) const { return {1 / scene.disk_area(), 1, false, true}; }

  constexpr EmissionNumbers emission_numbers(const Ray& start) const {
    const Vec2 u = scene.entering_numbers(start);
    return {u.x, u.y, kAnyNumber, kAnyNumber};
  }

  constexpr std::optional<Illumination> illuminate(const Vec3&) const {
    return Illumination{wi, kInfinity, irradiance, 0};
  }
};

}  // namespace dspm
