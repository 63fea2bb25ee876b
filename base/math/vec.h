// Two- and three-component float vectors, boxes of them, and orthonormal frames. A Vec3 is a point, a direction or a
// normal; its name says which.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "dspm/base/math/rounded.h"

namespace dspm {

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Vec2 {
  float x = 0, y = 0;
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};
constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(Vec2 a, float s) { return {a.x * s, a.y * s}; }

struct Vec3 {
  float x = 0, y = 0, z = 0;
  constexpr float operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr float& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr Vec3& operator+=(const Vec3& b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  constexpr Vec3& operator*=(float s) {
    x *= s, y *= s, z *= s;
    return *this;
  }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};
constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(const Vec3& a, float s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator*(float s, const Vec3& a) { return a * s; }
constexpr Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
constexpr Vec3 operator/(const Vec3& a, float s) { return {a.x / s, a.y / s, a.z / s}; }

constexpr float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr float length2(const Vec3& a) { return dot(a, a); }
constexpr float length(const Vec3& a) { return rounded::sqrt(length2(a)); }
constexpr Vec3 normalize(const Vec3& a) { return a / length(a); }
constexpr Vec3 abs(const Vec3& a) { return {std::abs(a.x), std::abs(a.y), std::abs(a.z)}; }
constexpr Vec3 min(const Vec3& a, const Vec3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
constexpr Vec3 max(const Vec3& a, const Vec3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
constexpr float max_component(const Vec3& a) { return std::max(a.x, std::max(a.y, a.z)); }
constexpr bool is_finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// An axis-aligned box; empty until something is added.
struct Bounds3 {
  Vec3 low{kInfinity, kInfinity, kInfinity};
  Vec3 high{-kInfinity, -kInfinity, -kInfinity};

  constexpr bool empty() const { return low.x > high.x || low.y > high.y || low.z > high.z; }
  constexpr void add(const Vec3& p) { low = min(low, p), high = max(high, p); }
  constexpr void add(const Bounds3& b) { low = min(low, b.low), high = max(high, b.high); }
  constexpr Vec3 center() const { return 0.5f * (low + high); }
  constexpr Vec3 extent() const { return high - low; }
  constexpr float half_area() const {
    const Vec3 e = extent();
    return empty() ? 0.f : e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

/// An orthonormal, right-handed set of directions around n, such as a shading frame: x is the tangent, z is n.
struct Basis {
  Vec3 x, y, z;

  /// Any basis around the unit vector n. [Duff et al. 2017, Building an Orthonormal Basis, Revisited]
  static constexpr Basis around(const Vec3& n) {
    const float sign = (rounded::is_negative(n.z) ? -1.f : 1.f), a = -1.f / (sign + n.z), b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }
  /// The basis around the unit vector n whose x is along the component of `tangent` perpendicular to n.
  static constexpr Basis around(const Vec3& n, const Vec3& tangent) {
    const Vec3 t = tangent - n * dot(n, tangent);
    const float l = length(t);
    if (!(l > 1e-6f * length(tangent))) return around(n);
    const Vec3 x = t / l;
    return {x, cross(n, x), n};
  }
  constexpr Vec3 to_local(const Vec3& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  constexpr Vec3 to_world(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

}  // namespace dspm
