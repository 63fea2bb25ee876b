// A rectangle in the world that light passes from its +z side: a window.
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"

namespace dspm {

struct Rectangle {
  Vec3 corner;
  Basis basis;  // x and y along its sides, z where the light comes from
  float width = 0, height = 0;

  float area() const { return width * height; }
  Vec3 at(Vec2 place) const { return corner + basis.x * (place.x * width) + basis.y * (place.y * height); }
  /// Returns where the line crosses it, both in [0, 1]; nullopt if it does not, or runs along it.
  std::optional<Vec2> place_of(const Ray& line) const {
    const Vec3 from = basis.to_local(line.origin - corner), along = basis.to_local(line.direction);
    const float t = -from.z / along.z;
    const Vec2 place{(from.x + t * along.x) / width, (from.y + t * along.y) / height};
    if (!(place.x >= 0 && place.x <= 1 && place.y >= 0 && place.y <= 1)) return std::nullopt;
    return place;
  }
  friend bool operator==(const Rectangle& a, const Rectangle& b) {
    return a.corner == b.corner && a.basis.x == b.basis.x && a.basis.y == b.basis.y && a.width == b.width &&
           a.height == b.height;
  }
};

/// Takes points in pbrt's order: x from the first point to the last, y from the first to the second. Returns nullopt if
/// they are no rectangle, up to a thousandth.
inline std::optional<Rectangle> rectangle_of(std::span<const Vec3> p) {
  if (p.size() != 4) return std::nullopt;
  const Vec3 x = p[3] - p[0], y = p[1] - p[0], x2 = p[2] - p[1], y2 = p[2] - p[3];
  const float width = length(x), height = length(y), size = width + height;
  constexpr float kTolerance = 1e-3f;
  const bool parallel = length(x - x2) <= kTolerance * size && length(y - y2) <= kTolerance * size;
  if (!(width > 0 && height > 0) || !parallel || std::abs(dot(x, y)) > kTolerance * width * height) return std::nullopt;
  Rectangle r{p[0], {}, width, height};
  r.basis.x = x / width;
  r.basis.z = normalize(cross(x, y));
  r.basis.y = cross(r.basis.z, r.basis.x);
  return r;
}

}  // namespace dspm
