#include "dspm/lang/gltf/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dspm/base/math/rounded.h"

namespace dspm::gltf {
namespace {

constexpr float kAzimuth = 25, kElevation = 20;  // degrees; the horizon is above the picture
constexpr float kMargin = 1.12f;

std::string listed(const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

/// To the corners, edges and sides of a cube.
std::vector<Vec3> directions_around() {
  std::vector<Vec3> directions;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0)
          directions.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  return directions;
}

}  // namespace

std::vector<std::size_t> outline_of(std::span<const Vec3> points, std::size_t most) {
  static const std::vector<Vec3> kDirections = directions_around();
  std::vector<std::size_t> chosen;
  if (points.empty()) return chosen;
  for (const Vec3& direction : kDirections) {
    std::size_t farthest = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (dot(points[i] - points[farthest], direction) > 0) farthest = i;
    chosen.push_back(farthest);
  }
  const std::size_t step = most == 0 ? points.size() : (points.size() + most - 1) / most;
  for (std::size_t i = 0; i < points.size(); i += step) chosen.push_back(i);
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

void Subject::add(std::span<const Vec3> seen) {
  for (const std::size_t i : outline_of(seen, 0)) {
    bounds.add(seen[i]);
    points.push_back(seen[i]);
  }
}

Vec3 towards(float azimuth, float elevation) {
  const rounded::SinCos around = rounded::sin_cos(azimuth * kPi / 180), up = rounded::sin_cos(elevation * kPi / 180);
  return {around.sin * up.cos, up.sin, -around.cos * up.cos};
}

std::string view_of(const Subject& subject, double aspect) {
  if (subject.bounds.empty()) return "LookAt 0 0 -5  0 0 0  0 1 0\n";
  const Vec3 back = towards(kAzimuth, kElevation), right = normalize(cross(Vec3{0, 1, 0}, -back)),
             up = cross(-back, right);
  const float half = rounded::tan(static_cast<float>(kUsualFov) / 360 * kPi);
  const float tan_y = half, tan_x = half * static_cast<float>(aspect);
  Vec3 target = subject.bounds.center();
  float distance = 0;
  for (int pass = 0; pass < 4; ++pass) {  // what is nearer seems larger, so the middle of the picture moves
    distance = 1e-3f * subject.radius();
    for (const Vec3& p : subject.points) {
      const Vec3 d = p - target;
      distance = std::max(
          distance, kMargin * std::max(std::abs(dot(d, right)) / tan_x, std::abs(dot(d, up)) / tan_y) + dot(d, back));
    }
    float low_x = kInfinity, high_x = -kInfinity, low_y = kInfinity, high_y = -kInfinity;
    for (const Vec3& p : subject.points) {
      const Vec3 d = p - target;
      const float z = std::max(distance - dot(d, back), 1e-6f), x = dot(d, right) / z, y = dot(d, up) / z;
      low_x = std::min(low_x, x), high_x = std::max(high_x, x), low_y = std::min(low_y, y),
      high_y = std::max(high_y, y);
    }
    target = target + right * (0.5f * (low_x + high_x) * distance) + up * (0.5f * (low_y + high_y) * distance);
  }
  return fmt::format("LookAt {}  {}  0 1 0\n", listed(target + back * distance), listed(target));
}

}  // namespace dspm::gltf
