// A neutral studio for a file that has no camera or no light.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "dspm/math/vec.h"

namespace dspm::gltf {

/// What is to be seen, in dspm's world: y is up, and the front faces -z.
struct Subject {
  Bounds3 bounds;
  std::vector<Vec3> points;  // some of its surface

  void add(const Vec3& point) {
    bounds.add(point);
    if (points.size() < 50'000) points.push_back(point);
  }
};

inline constexpr double kStudioFov = 28;  // degrees, over the height

/// Returns a LookAt from the front, a little from the right and from above, with all points in the picture.
std::string view_of(const Subject& subject, double aspect);

/// Returns a plain sky and a soft key light, or the sky of the file `hdr` alone.
std::string light_for(const Subject& subject, const std::string& hdr);

/// Returns a matte ground under the subject, as far as the picture goes.
std::string ground_for(const Subject& subject);

}  // namespace dspm::gltf
