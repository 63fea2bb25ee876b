// Vec3 in double, for the few steps of an intersection that decide a side or a sign.
#pragma once

#include "dspm/base/math/vec.h"

namespace dspm {

struct DoubleVec3 {
  double x, y, z;
};
constexpr DoubleVec3 operator*(const DoubleVec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr DoubleVec3 operator+(const DoubleVec3& a, const DoubleVec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr DoubleVec3 operator-(const DoubleVec3& a, const DoubleVec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr double dot(const DoubleVec3& a, const DoubleVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr DoubleVec3 cross(const DoubleVec3& a, const DoubleVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double length(const DoubleVec3& a) { return elementary::sqrt(dot(a, a)); }

constexpr DoubleVec3 widen(const Vec3& v) { return {v.x, v.y, v.z}; }
constexpr Vec3 narrow(const DoubleVec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
constexpr DoubleVec3 difference(const Vec3& a, const Vec3& b) {
  return {double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z};
}

}  // namespace dspm
