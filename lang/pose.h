// A placement in parts that can be interpolated: M = translation * rotation * stretch.
#pragma once

#include <array>

#include "dspm/base/math/transform.h"

namespace dspm {

using Quaternion = std::array<double, 4>;  // x, y, z, w

struct Pose {
  std::array<double, 3> translation;
  Quaternion rotation;
  std::array<std::array<double, 3>, 3> stretch;  // scale and shear, and mirroring
};

Pose decompose(const Matrix4& matrix);
Matrix4 compose(const Pose& pose);

/// Equal values stay equal: rounding would make them distinct states.
inline double mix(double a, double b, double t) { return a == b ? a : (1 - t) * a + t * b; }

/// q and -q are the same rotation: of both, the one nearer to `other`.
Quaternion nearer(const Quaternion& q, const Quaternion& other);
/// Of a rotation by the way from a to b, the axis; zero if they are the same.
std::array<double, 3> axis_between(const Quaternion& a, const Quaternion& b);
/// From a (at 0) to b (at 1), the shorter way, and on it as many full turns more; a negative number goes the other way
/// round.
Matrix4 interpolate(const Matrix4& a, const Matrix4& b, double t, int turns = 0);
/// Turns the pose meanwhile, by t times `turns` full turns about the axis of the way from a to b.
Matrix4 compose_turning(const Pose& pose, const Quaternion& a, const Quaternion& b, double t, int turns);

}  // namespace dspm
