// What there is to see, and where a camera sees all of it.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "dspm/base/math/vec.h"

namespace dspm::gltf {

/// Of these points, ascending: at most `most` that lie evenly in their order, and those that are farthest in 26
/// directions.
std::vector<std::size_t> outline_of(std::span<const Vec3> points, std::size_t most);

/// What is to be seen, in dspm's world: y is up, and the front faces -z.
struct Subject {
  Bounds3 bounds;
  std::vector<Vec3> points;  // of its outline, as seen from anywhere

  void add(std::span<const Vec3> seen);
  Vec3 center() const { return bounds.empty() ? Vec3() : bounds.center(); }
  /// Of a sphere around it.
  float radius() const { return bounds.empty() ? 1 : std::max(0.5f * length(bounds.extent()), 1e-6f); }
};

inline constexpr double kUsualFov = 28;  // degrees, over the height

/// From the subject to a place at that azimuth, which is 0 in front of it and grows to the right, and elevation.
Vec3 towards(float azimuth, float elevation);

/// A LookAt from the front, a little from the right and from above, with all points in the picture.
std::string view_of(const Subject& subject, double aspect);

}  // namespace dspm::gltf
