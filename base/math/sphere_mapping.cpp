#include "dspm/base/math/sphere_mapping.h"

#include "dspm/base/math/rounded.h"

namespace dspm {
namespace {

// The square with corners at -1 and 1. The diamond |x| + |y| <= 1 is the upper hemisphere; each of the four triangles
// outside is the lower one's quadrant, folded over the diamond's edge. In the first quadrant, rings x + y = r have z =
// 1 - r^2, and y / r is the fraction of the quarter turn.
Vec3 octahedral_direction(Vec2 place) {
  const float x = 2 * place.x - 1, y = 2 * place.y - 1;
  const float ax = std::abs(x), ay = std::abs(y);
  const float above = 1 - ax - ay;  // below 0 in the lower hemisphere
  const float r = 1 - std::abs(above);
  const float turn = r > 0 ? 0.5f * (1 + (ay - ax) / r) : 0.5f;
  const float phi = turn * (kPi / 2), sin_theta = r * std::sqrt(2 - r * r);
  return {std::copysign(rounded::cos(phi) * sin_theta, x), std::copysign(rounded::sin(phi) * sin_theta, y),
          std::copysign(1 - r * r, above)};
}

Vec2 octahedral_place(const Vec3& d) {
  // 1 - |z| without cancellation near the poles.
  const float r = std::sqrt((d.x * d.x + d.y * d.y) / (1 + std::abs(d.z)));
  const float turn = rounded::atan2(std::abs(d.y), std::abs(d.x)) / (kPi / 2);
  float y = turn * r, x = r - y;
  if (d.z < 0) {
    const float unfolded = x;
    x = 1 - y, y = 1 - unfolded;
  }
  return {0.5f * (1 + std::copysign(x, d.x)), 0.5f * (1 + std::copysign(y, d.y))};
}

Vec3 polar_direction(Vec2 place) {
  const float phi = 2 * kPi * place.x, theta = kPi * place.y, s = rounded::sin(theta);
  return {rounded::cos(phi) * s, rounded::sin(phi) * s, rounded::cos(theta)};
}

Vec2 polar_place(const Vec3& d) {
  const float turn = rounded::atan2(d.y, d.x) / (2 * kPi);
  return {turn < 0 ? turn + 1 : turn, rounded::atan2(rounded::hypot(d.x, d.y), d.z) / kPi};
}

}  // namespace

Vec3 direction_at(SphereMapping mapping, Vec2 place) {
  return mapping == SphereMapping::equal_area ? octahedral_direction(place) : polar_direction(place);
}

Vec2 place_of(SphereMapping mapping, const Vec3& direction) {
  return mapping == SphereMapping::equal_area ? octahedral_place(direction) : polar_place(direction);
}

}  // namespace dspm
