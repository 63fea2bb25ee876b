#include "dspm/base/math/sampling.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/rounded.h"

namespace dspm {
namespace {

constexpr float kBelowOne = 0x1.fffffep-1f;  // the largest float below 1

/// Returns the direction at height z whose azimuth is the fraction u of a turn; r2 = 1 - z^2.
Vec3 at_height(float z, float r2, float u) {
  const float r = std::sqrt(std::max(r2, 0.f)), phi = 2 * kPi * u;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

struct SinCos {
  float sin, cos;
};

/// Takes angles up to pi/4, and is accurate to the last digits of a float: Taylor series up to x^9 and x^8. It is
/// several times faster than the library's functions, which accept any angle.
SinCos sin_cos_of_octant(float x) {
  const float x2 = x * x;
  return {x * (1 - x2 * (1 / 6.f) * (1 - x2 * (1 / 20.f) * (1 - x2 * (1 / 42.f) * (1 - x2 * (1 / 72.f))))),
          1 - x2 * 0.5f * (1 - x2 * (1 / 12.f) * (1 - x2 * (1 / 30.f) * (1 - x2 * (1 / 56.f))))};
}

}  // namespace

Vec2 concentric_disk(Vec2 u) {
  const float x = 2 * u.x - 1, y = 2 * u.y - 1;
  if (x == 0 && y == 0) return {};
  const bool wide = std::abs(x) > std::abs(y);
  const float r = wide ? x : y, other = wide ? y : x;
  const SinCos angle = sin_cos_of_octant(kPi / 4 * (other / r));  // from the axis of r
  return wide ? Vec2{r * angle.cos, r * angle.sin} : Vec2{r * angle.sin, r * angle.cos};
}

Vec2 concentric_disk_numbers(Vec2 p) {
  const float r = std::hypot(p.x, p.y);
  if (r == 0) return {0.5f, 0.5f};
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float along = std::copysign(r, wide ? p.x : p.y);
  const float across = along * (wide ? rounded::atan(p.y / p.x) : rounded::atan(p.x / p.y)) / (kPi / 4);
  const Vec2 square = wide ? Vec2{along, across} : Vec2{across, along};
  return {0.5f * (square.x + 1), 0.5f * (square.y + 1)};
}

Vec3 cosine_hemisphere(Vec2 u) {
  const Vec2 d = concentric_disk(u);
  return {d.x, d.y, std::sqrt(std::max(1 - d.x * d.x - d.y * d.y, 0.f))};
}

Vec3 uniform_sphere(Vec2 u) { return at_height(1 - 2 * u.x, 4 * u.x * (1 - u.x), u.y); }

float turn_of(const Vec3& w) {
  const float turn = rounded::atan2(w.y, w.x) / (2 * kPi);
  return turn < 0 ? std::min(turn + 1, kBelowOne) : turn;
}

Vec2 uniform_sphere_numbers(const Vec3& w) {
  const float x = w.z > 0 ? (w.x * w.x + w.y * w.y) / (2 * (1 + w.z)) : 0.5f * (1 - w.z);
  return {x, turn_of(w)};
}

Vec3 uniform_hemisphere(Vec2 u) { return at_height(1 - u.x, u.x * (2 - u.x), u.y); }

Vec3 uniform_cone(Vec2 u, float one_minus_cos_max) {
  const float h = u.x * one_minus_cos_max;  // 1 - cos of the angle
  return at_height(1 - h, h * (2 - h), u.y);
}

Vec2 uniform_triangle(Vec2 u) { return u.x < u.y ? Vec2{u.x / 2, u.y - u.x / 2} : Vec2{u.x - u.y / 2, u.y / 2}; }

Vec2 uniform_triangle_numbers(Vec2 b) { return b.x < b.y ? Vec2{2 * b.x, b.x + b.y} : Vec2{b.x + b.y, 2 * b.y}; }

Distribution1D::Distribution1D(std::span<const float> weights) {
  double total = 0;
  for (const float weight : weights) total += static_cast<double>(weight);
  total_ = static_cast<float>(total);
  const double n = static_cast<double>(weights.size());
  double sum = 0;
  bins_.resize(weights.size() + 1);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += total > 0 ? static_cast<double>(weights[i]) / total : 1 / n;
    bins_[i + 1].begin = static_cast<float>(std::min(sum, 1.));
  }
  // Rounding may leave the last steps short of 1; bins of zero weight at the end must stay empty.
  const float end = bins_.back().begin;
  for (std::size_t i = weights.size(); i > 0 && bins_[i].begin == end; --i) bins_[i].begin = 1;
  add_cutpoints(bins(), cutpoints_);
}

}  // namespace dspm
