// Warps of uniform numbers in [0, 1) to directions and points, each with its density. Directions are around +z.
#pragma once

#include <algorithm>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// Uniform on the unit disk; neighbours stay neighbours. Density 1 / pi. [Shirley and Chiu 1997]
constexpr Vec2 concentric_disk(Vec2 u) {
  const float x = 2 * u.x - 1, y = 2 * u.y - 1;
  if (x == 0 && y == 0) return {};
  const bool wide = std::abs(x) > std::abs(y);
  const float r = wide ? x : y, other = wide ? y : x;
  // Sine and cosine of the angle from the axis of r, at most pi / 4: Taylor series, to the last digits of a float.
  const float a = kPi / 4 * (other / r), a2 = a * a;
  const float sin = a * (1 - a2 * (1 / 6.f) * (1 - a2 * (1 / 20.f) * (1 - a2 * (1 / 42.f) * (1 - a2 * (1 / 72.f)))));
  const float cos = 1 - a2 * 0.5f * (1 - a2 * (1 / 12.f) * (1 - a2 * (1 / 30.f) * (1 - a2 * (1 / 56.f))));
  return wide ? Vec2{r * cos, r * sin} : Vec2{r * sin, r * cos};
}
/// Returns the u with concentric_disk(u) = p.
constexpr Vec2 concentric_disk_numbers(Vec2 p) {
  const float r = rounded::hypot(p.x, p.y);
  if (r == 0) return {0.5f, 0.5f};
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float along = rounded::is_negative(wide ? p.x : p.y) ? -r : r;
  const float across = along * rounded::atan(wide ? p.y / p.x : p.x / p.y) / (kPi / 4);
  const Vec2 square = wide ? Vec2{along, across} : Vec2{across, along};
  return {0.5f * (square.x + 1), 0.5f * (square.y + 1)};
}

/// Density cos / pi per solid angle.
constexpr Vec3 cosine_hemisphere(Vec2 u) {
  const Vec2 d = concentric_disk(u);
  return {d.x, d.y, rounded::sqrt(std::max(1 - d.x * d.x - d.y * d.y, 0.f))};
}
constexpr float cosine_hemisphere_pdf_w(float cos_theta) { return std::max(cos_theta, 0.f) / kPi; }

/// Returns the unit vector at height z whose azimuth is that fraction of a turn; r2 = 1 - z^2.
constexpr Vec3 direction_at_height(float z, float r2, float turn) {
  const float r = rounded::sqrt(std::max(r2, 0.f));
  const rounded::SinCos phi = rounded::sin_cos(2 * kPi * turn);
  return {r * phi.cos, r * phi.sin, z};
}
/// The azimuth of w as a fraction of a turn, in [0, 1).
constexpr float turn_of(const Vec3& w) {
  constexpr float kBelowOne = 0x1.fffffep-1f;  // the largest float below 1
  const float turn = rounded::atan2(w.y, w.x) / (2 * kPi);
  return turn < 0 ? std::min(turn + 1, kBelowOne) : turn;
}

constexpr Vec3 uniform_sphere(Vec2 u) { return direction_at_height(1 - 2 * u.x, 4 * u.x * (1 - u.x), u.y); }
/// Returns the u with uniform_sphere(u) = w.
constexpr Vec2 uniform_sphere_numbers(const Vec3& w) {
  const float x = w.z > 0 ? (w.x * w.x + w.y * w.y) / (2 * (1 + w.z)) : 0.5f * (1 - w.z);
  return {x, turn_of(w)};
}
inline constexpr float kUniformSpherePdfW = 1 / (4 * kPi);

constexpr Vec3 uniform_hemisphere(Vec2 u) { return direction_at_height(1 - u.x, u.x * (2 - u.x), u.y); }
inline constexpr float kUniformHemispherePdfW = 1 / (2 * kPi);

/// Directions around z within the angle of cosine cos_max. Takes 1 - cos_max because in a narrow cone cos_max itself
/// has no digits left.
constexpr Vec3 uniform_cone(Vec2 u, float one_minus_cos_max) {
  const float h = u.x * one_minus_cos_max;  // 1 - cos of the angle
  return direction_at_height(1 - h, h * (2 - h), u.y);
}
constexpr float uniform_cone_pdf_w(float one_minus_cos_max) { return 1 / (2 * kPi * one_minus_cos_max); }

/// Barycentric coordinates (b1, b2) of a point uniform on a triangle's area; b0 = 1 - b1 - b2. [Heitz 2019]
constexpr Vec2 uniform_triangle(Vec2 u) {
  return u.x < u.y ? Vec2{u.x / 2, u.y - u.x / 2} : Vec2{u.x - u.y / 2, u.y / 2};
}
/// Returns the u with uniform_triangle(u) = b.
constexpr Vec2 uniform_triangle_numbers(Vec2 b) {
  return b.x < b.y ? Vec2{2 * b.x, b.x + b.y} : Vec2{b.x + b.y, 2 * b.y};
}

}  // namespace dspm
