#include "dspm/lights/seen_triangle.h"

#include <algorithm>
#include <cmath>

namespace dspm {
namespace {

// Edges that are a quarter as long as the triangle is far away change cos / distance^2 by a quarter: little beside what
// materials and shadows do.
constexpr float kNear = 0.25f;
constexpr double kLeastSolidAngle = 1e-7;

}  // namespace

SeenTriangle::Direction SeenTriangle::cross(const Direction& a, const Direction& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
SeenTriangle::Direction SeenTriangle::sum(const Direction& a, double s, const Direction& b, double t) {
  return {a.x * s + b.x * t, a.y * s + b.y * t, a.z * s + b.z * t};
}
/// Returns the unit vector along the part of v that is perpendicular to `from`.
SeenTriangle::Direction SeenTriangle::across(const Direction& v, const Direction& from) {
  const Direction part = sum(v, 1, from, -dot(v, from));
  const double length = std::sqrt(dot(part, part));
  return length > 0 ? sum(part, 1 / length, part, 0) : part;
}

// tan of half the solid angle. [van Oosterom and Strackee 1983]
SeenTriangle::SeenTriangle(const std::array<Vec3, 3>& corners, const Vec3& from) {
  const Vec3 d = (corners[0] + corners[1] + corners[2]) / 3 - from;
  const float longest =
      std::max({length2(corners[1] - corners[0]), length2(corners[2] - corners[1]), length2(corners[0] - corners[2])});
  if (!(longest > kNear * kNear * length2(d))) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto wide = [](float x) { return static_cast<double>(x); };
    to_[i] = {wide(corners[i].x) - wide(from.x), wide(corners[i].y) - wide(from.y), wide(corners[i].z) - wide(from.z)};
    const double length = std::sqrt(dot(to_[i], to_[i]));
    if (!(length > 0)) return;
    w_[i] = sum(to_[i], 1 / length, to_[i], 0);
  }
  const double volume = std::abs(dot(w_[0], cross(w_[1], w_[2])));
  const double rest = 1 + dot(w_[0], w_[1]) + dot(w_[1], w_[2]) + dot(w_[2], w_[0]);
  const double angle = 2 * std::atan2(volume, rest);
  if (!(angle > kLeastSolidAngle)) return;
  solid_angle_ = angle, near_ = true;
}

// u.x cuts a triangle of that part of the solid angle off at the first corner; u.y goes along the arc from the second
// corner to the cut. [Arvo 1995]
Vec2 SeenTriangle::sample(Vec2 u) const {
  const auto& [a, b, c] = w_;
  const Direction to_b = across(b, a), to_c = across(c, a);
  const double cos_alpha = std::clamp(dot(to_b, to_c), -1., 1.);
  const double sin_alpha = std::sqrt(std::max(0., 1 - cos_alpha * cos_alpha));
  const double cos_c = dot(a, b);
  const double part = static_cast<double>(u.x) * solid_angle_, alpha = std::acos(cos_alpha);
  const double s = std::sin(part - alpha), t = std::cos(part - alpha);
  const double p = t - cos_alpha, q = s + sin_alpha * cos_c;
  const double below = (q * s + p * t) * sin_alpha;
  const double cos_b = below != 0 ? std::clamp(((q * t - p * s) * cos_alpha - q) / below, -1., 1.) : cos_c;
  const Direction cut = sum(a, cos_b, to_c, std::sqrt(std::max(0., 1 - cos_b * cos_b)));
  const double z = 1 - static_cast<double>(u.y) * (1 - dot(cut, b));
  const Direction w = sum(b, z, across(cut, b), std::sqrt(std::max(0., 1 - z * z)));
  // Where the ray meets the plane: ratios of volumes.
  const double v0 = dot(w, cross(to_[1], to_[2])), v1 = dot(w, cross(to_[2], to_[0])),
               v2 = dot(w, cross(to_[0], to_[1]));
  const double all = v0 + v1 + v2;
  if (!(all != 0)) return {1 / 3.f, 1 / 3.f};
  const double b1 = std::clamp(v1 / all, 0., 1.), b2 = std::clamp(v2 / all, 0., 1 - b1);
  return {static_cast<float>(b1), static_cast<float>(b2)};
}

}  // namespace dspm
