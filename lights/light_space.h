// The space in which a light is described, where directions are concerned: it may be turned, mirrored and stretched.
#pragma once

#include <cmath>

#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"

namespace dspm {

class LightSpace {
 public:
  /// The light's axis that is the third one of its directions, as maps have them; for y, y and z change places.
  enum class Up { z, y };

  explicit LightSpace(const Transform& to_world, Up up = Up::z)
      : to_world_(to_world),
        up_(up),
        volume_scale_(std::abs(
            dot(to_world_.vector({1, 0, 0}), cross(to_world_.vector({0, 1, 0}), to_world_.vector({0, 0, 1}))))) {}

  Vec3 to_world(const Vec3& direction) const { return normalize(to_world_.vector(placed(direction))); }
  Vec3 to_light(const Vec3& direction) const { return normalize(placed(to_world_.inverse_vector(direction))); }

  /// Returns the factor from the density of a direction in the light's space to that in the world. A map M turns a
  /// solid angle around the unit vector w into |det M| / |M w|^3 of it: 1 unless M stretches.
  float density_scale(const Vec3& in_light) const {
    const float stretch = length(to_world_.vector(placed(in_light)));
    return stretch * stretch * stretch / volume_scale_;
  }
  friend bool operator==(const LightSpace&, const LightSpace&) = default;

 private:
  Vec3 placed(const Vec3& v) const { return up_ == Up::z ? v : Vec3{v.x, v.z, v.y}; }

  Transform to_world_;
  Up up_;
  float volume_scale_;
};

}  // namespace dspm
