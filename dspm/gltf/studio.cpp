#include "dspm/gltf/studio.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dspm/gltf/statements.h"

namespace dspm::gltf {
namespace {

constexpr float kAzimuth = 25, kElevation = 20;  // degrees; the horizon is above the picture
constexpr float kMargin = 1.12f;

std::string listed(const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

float size_of(const Subject& subject) { return std::max(0.5f * length(subject.bounds.extent()), 1e-6f); }

/// Returns the direction from the subject to a place at that azimuth and elevation.
Vec3 towards(float azimuth, float elevation) {
  const float a = azimuth * kPi / 180, e = elevation * kPi / 180;
  return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

}  // namespace

std::string view_of(const Subject& subject, double aspect) {
  if (subject.bounds.empty()) return "LookAt 0 0 -5  0 0 0  0 1 0\n";
  const Vec3 back = towards(kAzimuth, kElevation), right = normalize(cross(Vec3{0, 1, 0}, -back)),
             up = cross(-back, right);
  const float half = std::tan(static_cast<float>(kStudioFov) / 360 * kPi);
  const float tan_y = half, tan_x = half * static_cast<float>(aspect);
  Vec3 target = subject.bounds.center();
  float distance = 0;
  for (int pass = 0; pass < 4; ++pass) {  // what is nearer seems larger, so the middle of the picture moves
    distance = 1e-3f * size_of(subject);
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

std::string light_for(const Subject& subject, const std::string& hdr) {
  if (!hdr.empty())
    return fmt::format(
        "AttributeBegin\n  Rotate -90 1 0 0\n  LightSource \"infinite\" \"string filename\" {}\nAttributeEnd\n",
        in_quotes(hdr));
  const float size = subject.bounds.empty() ? 1 : size_of(subject);
  const Vec3 centre = subject.bounds.empty() ? Vec3{} : subject.bounds.center();
  const Vec3 key = centre + towards(-40, 50) * (6 * size);
  return fmt::format(
      "LightSource \"infinite\" \"rgb L\" [.55 .58 .62]\n"
      "AttributeBegin  # a soft key, behind the camera on the left\n"
      "  Translate {}\n"
      "  Rotate 40 0 1 0\n"
      "  Rotate 50 1 0 0\n"
      "  AreaLightSource \"diffuse\" \"rgb L\" [14 13.4 12.6]\n"
      "  Shape \"disk\" \"float radius\" {}\n"
      "AttributeEnd\n",
      listed(key), 1.4f * size);
}

std::string ground_for(const Subject& subject) {
  if (subject.bounds.empty()) return {};
  const float size = size_of(subject);
  const Vec3 centre = subject.bounds.center();
  return fmt::format(
      "AttributeBegin  # the ground\n"
      "  Translate {} {} {}\n"
      "  Rotate -90 1 0 0\n"
      "  Material \"diffuse\" \"rgb reflectance\" [.6 .6 .6]\n"
      "  Shape \"disk\" \"float radius\" {}\n"
      "AttributeEnd\n",
      centre.x, subject.bounds.low.y - 1e-4f * size, centre.z, 100 * size);
}

}  // namespace dspm::gltf
