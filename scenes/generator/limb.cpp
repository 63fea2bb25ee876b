// Legs, rails and arms; see surface.h.
#include <algorithm>
#include <cmath>

#include "dspm/base/math/vec.h"
#include "scenes/generator/surface.h"

namespace dspm {
namespace {

constexpr int kSides = 40, kRows = 96;
constexpr float kCap = 0.07f;  // fraction of v that each end takes

/// [Catmull, Rom 1974]; the ends' slopes are those of their neighbours' chords.
template <class T>
T between(const T& a, const T& b, const T& c, const T& d, float t) {
  const float t2 = t * t, t3 = t2 * t;
  return (b * 2 + (c - a) * t + (a * 2 - b * 5 + c * 4 - d) * t2 + (b * 3 - a - c * 3 + d) * t3) * 0.5f;
}

/// Through all stations; `along` is 0 at the first and 1 at the last.
Station station_at(const std::vector<Station>& all, float along) {
  const int last = static_cast<int>(all.size()) - 1;
  const float x = along * static_cast<float>(last);
  const int i = std::clamp(static_cast<int>(std::floor(x)), 0, last - 1);
  const auto at = [&](int k) { return all[static_cast<std::size_t>(std::clamp(k, 0, last))]; };
  const auto a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
  const float t = x - static_cast<float>(i);
  const Vec3 before = i > 0 ? a.at : b.at * 2 - c.at, behind = i + 2 <= last ? d.at : c.at * 2 - b.at;
  return {between(before, b.at, c.at, behind, t), between(a.half_width, b.half_width, c.half_width, d.half_width, t),
          between(a.half_depth, b.half_depth, c.half_depth, d.half_depth, t)};
}

/// Where a ring of the limb lies: along its path, and on the rounded ends before and after that.
struct Ring {
  float along, shrink, beyond;
};

Ring ring_at(float v) {
  const auto cap = [](float x) { return x * kPi / 2; };
  if (v < kCap) return {0, std::sin(cap(v / kCap)), -std::cos(cap(v / kCap))};
  if (v > 1 - kCap) return {1, std::sin(cap((1 - v) / kCap)), std::cos(cap((1 - v) / kCap))};
  return {(v - kCap) / (1 - 2 * kCap), 1, 0};
}

/// Radius of |x|^n + |y|^n = 1 in the direction of the angle.
float superellipse(float angle, float n) {
  return std::pow(std::pow(std::abs(std::cos(angle)), n) + std::pow(std::abs(std::sin(angle)), n), -1 / n);
}

float path_length(const std::vector<Station>& stations) {
  constexpr int kSteps = 64;
  float sum = 0;
  for (int i = 0; i < kSteps; ++i)
    sum += length(station_at(stations, static_cast<float>(i + 1) / kSteps).at -
                  station_at(stations, static_cast<float>(i) / kSteps).at);
  return sum;
}

}  // namespace

MeshData limb(const std::vector<Station>& stations, const Vec3& side, float roundness, Vec2 texture_offset) {
  const Surface surface = [&](float u, float v) {
    const Ring ring = ring_at(v);
    const Station here = station_at(stations, ring.along);
    constexpr float kStep = 1e-2f;
    const Vec3 tangent = normalize(station_at(stations, std::min(ring.along + kStep, 1.f)).at -
                                   station_at(stations, std::max(ring.along - kStep, 0.f)).at);
    const Basis basis = Basis::around(tangent, side);
    const float angle = 2 * kPi * u, radius = superellipse(angle, roundness) * ring.shrink;
    const float cap_length = 0.35f * std::min(here.half_width, here.half_depth);
    return here.at + tangent * (ring.beyond * cap_length) + basis.x * (radius * here.half_width * std::cos(angle)) +
           basis.y * (radius * here.half_depth * std::sin(angle));
  };
  const Station middle = station_at(stations, 0.5f);
  const float girth = kPi * (middle.half_width + middle.half_depth), length = path_length(stations);
  return patch(kSides, kRows, surface, [&](float u, float v) {
    return texture_offset + Vec2{u * girth, ring_at(v).along * length};
  });
}

}  // namespace dspm
