// The sphere around the scene, as lights at infinity see it: a disk perpendicular to their direction.
#pragma once

#include "dspm/base/math/ray.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"

namespace dspm {

struct SceneSphere {
  Vec3 center;
  float radius = 1;

  static constexpr float kClear = 1.01f;  // of the radius: exceeds any rounding error

  constexpr float disk_area() const { return kPi * radius * radius; }
  /// Returns a ray against the unit vector `towards_light`, uniform over the disk, that starts clear of the sphere.
  constexpr Ray entering(const Vec3& towards_light, Vec2 u) const {
    const Vec2 offset = concentric_disk(u) * radius;
    const Basis basis = Basis::around(towards_light);
    return {center + basis.to_world({offset.x, offset.y, kClear * radius}), -towards_light};
  }
  /// Returns the u with which that line enters.
  constexpr Vec2 entering_numbers(const Ray& line) const {
    const Vec3 offset = Basis::around(-line.direction).to_local(line.origin - center);
    return concentric_disk_numbers(Vec2{offset.x, offset.y} * (1 / radius));
  }
};

}  // namespace dspm
