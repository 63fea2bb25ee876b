#include "dspm/lang/pose.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/vanishing.h"

namespace dspm {
namespace {

double dot(const Quaternion& a, const Quaternion& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

template <std::size_t N>
std::array<double, N> mix(const std::array<double, N>& a, const std::array<double, N>& b, double t) {
  std::array<double, N> r;
  for (std::size_t i = 0; i < N; ++i) r[i] = dspm::mix(a[i], b[i], t);
  return r;
}

Quaternion quaternion_of(const Matrix4& rotation) {
  const auto& m = rotation.m;
  const double trace = m[0][0] + m[1][1] + m[2][2];
  if (trace > 0) {
    const double s = 2 * std::sqrt(1 + trace);
    return {(m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4};
  }
  std::size_t i = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (m[k][k] > m[i][i]) i = k;
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  const double s = 2 * std::sqrt(std::max(0.0, 1 + m[i][i] - m[j][j] - m[k][k]));
  Quaternion q;
  q[i] = s / 4, q[j] = (m[j][i] + m[i][j]) / s, q[k] = (m[k][i] + m[i][k]) / s, q[3] = (m[k][j] - m[j][k]) / s;
  return q;
}

/// Of any length but 0.
Matrix4 matrix_of(Quaternion q) {
  const double length = std::sqrt(dot(q, q));
  for (double& v : q) v /= length;
  const auto [x, y, z, w] = q;
  Matrix4 r;
  r.m[0] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0};
  r.m[1] = {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0};
  r.m[2] = {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0};
  return r;
}

Quaternion slerp(const Quaternion& a, const Quaternion& other, double t) {
  const Quaternion b = nearer(other, a);
  const double angle = std::acos(std::min(dot(a, b), 1.0));
  Quaternion r = mix(a, b, t);
  if (angle > 1e-6)
    for (std::size_t i = 0; i < 4; ++i)
      r[i] = (std::sin((1 - t) * angle) * a[i] + std::sin(t * angle) * b[i]) / std::sin(angle);
  return r;
}

double determinant3(const Matrix4& a) {
  const auto& m = a.m;
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// The rotation nearest to a regular linear map, by Newton's iteration R <- (s R + R^-T / s) / 2; the scaling s by
/// determinants makes a few steps enough [Higham 1986, Computing the Polar Decomposition]. Mirroring goes into the
/// stretch.
Matrix4 rotation_of(Matrix4 linear) {
  if (determinant3(linear) < 0)
    for (std::size_t i = 0; i < 3; ++i)
      for (double& v : linear.m[i]) v = -v;
  for (int step = 0; step < 100; ++step) {
    const auto inverse = linear.inverse();
    if (!inverse) break;
    const double s = 1 / std::cbrt(determinant3(linear));
    double change = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        change = std::max(change, std::abs(s * linear.m[i][j] - inverse->m[j][i] / s));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) linear.m[i][j] = (s * linear.m[i][j] + inverse->m[j][i] / s) / 2;
    if (change < 1e-15) break;
  }
  return linear;
}

}  // namespace

Pose decompose(const Matrix4& matrix) {
  const auto& m = matrix.m;
  Matrix4 linear = matrix;
  for (std::size_t i = 0; i < 3; ++i) linear.m[i][3] = 0;
  const Matrix4 rotation = rotation_of(linear);
  std::array<std::array<double, 3>, 3> stretch{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) stretch[i][j] += rotation.m[k][i] * linear.m[k][j];
  return {{m[0][3], m[1][3], m[2][3]}, quaternion_of(rotation), stretch};
}

Quaternion nearer(const Quaternion& q, const Quaternion& other) {
  return dot(q, other) < 0 ? Quaternion{-q[0], -q[1], -q[2], -q[3]} : q;
}

Matrix4 compose(const Pose& pose) {
  const auto& [translation, rotation, stretch] = pose;
  Matrix4 stretched;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) stretched.m[i][j] = stretch[i][j];
  return Matrix4::translate(translation[0], translation[1], translation[2]) * matrix_of(rotation) * stretched;
}

std::array<double, 3> axis_between(const Quaternion& a, const Quaternion& other) {
  constexpr double kNone = 1e-9;
  const Quaternion b = nearer(other, a);
  // The vector part of b a^-1.
  const std::array<double, 3> axis{a[3] * b[0] - b[3] * a[0] - (b[1] * a[2] - b[2] * a[1]),
                                   a[3] * b[1] - b[3] * a[1] - (b[2] * a[0] - b[0] * a[2]),
                                   a[3] * b[2] - b[3] * a[2] - (b[0] * a[1] - b[1] * a[0])};
  const double length2 = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
  return length2 > kNone * kNone ? axis : std::array<double, 3>{};
}

Matrix4 compose_turning(const Pose& pose, const Quaternion& a, const Quaternion& b, double t, int turns) {
  const std::array<double, 3> axis = axis_between(a, b);
  if (turns == 0 || axis == std::array<double, 3>{}) return compose(pose);
  const auto& [x, y, z] = pose.translation;
  Pose at_origin = pose;
  at_origin.translation = {};
  return Matrix4::translate(x, y, z) * Matrix4::rotate(360 * t * turns, axis[0], axis[1], axis[2]) * compose(at_origin);
}

Matrix4 interpolate(const Matrix4& a, const Matrix4& b, double t, int turns) {
  if (a == b) return a;
  Pose from = decompose(a), to = decompose(b);
  // Nothing has no rotation, so it takes the other's.
  if (vanishes(a)) from.rotation = to.rotation, from.stretch = {};
  if (vanishes(b)) to.rotation = from.rotation, to.stretch = {};
  Pose pose{mix(from.translation, to.translation, t), slerp(from.rotation, to.rotation, t), {}};
  for (std::size_t i = 0; i < 3; ++i) pose.stretch[i] = mix(from.stretch[i], to.stretch[i], t);
  return compose_turning(pose, from.rotation, to.rotation, t, turns);
}

}  // namespace dspm
