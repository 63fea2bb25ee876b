#include "dspm/base/math/transform.h"

#include <cmath>
#include <stdexcept>

namespace dspm {
namespace {

using Double3 = std::array<double, 3>;

Double3 cross3(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::optional<Double3> unit(const Double3& v) {
  const double l = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  if (!(l > 0) || !std::isfinite(l)) return std::nullopt;
  return Double3{v[0] / l, v[1] / l, v[2] / l};
}

}  // namespace

Matrix4 Matrix4::translate(double x, double y, double z) {
  Matrix4 r;
  r.m[0][3] = x, r.m[1][3] = y, r.m[2][3] = z;
  return r;
}

Matrix4 Matrix4::scale(double x, double y, double z) {
  Matrix4 r;
  r.m[0][0] = x, r.m[1][1] = y, r.m[2][2] = z;
  return r;
}

Matrix4 Matrix4::rotate(double degrees, double x, double y, double z) {
  const auto a = unit({x, y, z});
  if (!a) throw std::invalid_argument("the rotation's axis is zero");
  const double radians = degrees * (3.14159265358979323846 / 180), c = std::cos(radians), s = std::sin(radians);
  const auto [ax, ay, az] = *a;
  Matrix4 r;
  r.m[0] = {ax * ax + (1 - ax * ax) * c, ax * ay * (1 - c) - az * s, ax * az * (1 - c) + ay * s, 0};
  r.m[1] = {ax * ay * (1 - c) + az * s, ay * ay + (1 - ay * ay) * c, ay * az * (1 - c) - ax * s, 0};
  r.m[2] = {ax * az * (1 - c) - ay * s, ay * az * (1 - c) + ax * s, az * az + (1 - az * az) * c, 0};
  return r;
}

std::optional<Matrix4> Matrix4::look_at(const Double3& eye, const Double3& look, const Double3& up) {
  const auto forward = unit({look[0] - eye[0], look[1] - eye[1], look[2] - eye[2]});
  const auto upward = unit(up);
  if (!forward || !upward) return std::nullopt;
  const auto right = unit(cross3(*upward, *forward));
  if (!right) return std::nullopt;
  const Double3 true_up = cross3(*forward, *right);
  Matrix4 camera_to_world;
  for (std::size_t i = 0; i < 3; ++i) camera_to_world.m[i] = {(*right)[i], true_up[i], (*forward)[i], eye[i]};
  return camera_to_world.inverse();
}

Matrix4 Matrix4::from_columns(const std::array<double, 16>& values) {
  Matrix4 r;
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) r.m[row][column] = values[4 * column + row];
  return r;
}

Matrix4 operator*(const Matrix4& a, const Matrix4& b) {
  Matrix4 r;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j] + a.m[i][3] * b.m[3][j];
  return r;
}

// Gauss-Jordan elimination with partial pivoting.
std::optional<Matrix4> Matrix4::inverse() const {
  auto a = m;
  Matrix4 result;
  auto& b = result.m;
  for (std::size_t column = 0; column < 4; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < 4; ++row)
      if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
    if (a[pivot][column] == 0 || !std::isfinite(a[pivot][column])) return std::nullopt;
    std::swap(a[pivot], a[column]);
    std::swap(b[pivot], b[column]);
    const double scale = 1 / a[column][column];
    for (std::size_t k = 0; k < 4; ++k) a[column][k] *= scale, b[column][k] *= scale;
    for (std::size_t row = 0; row < 4; ++row) {
      if (row == column) continue;
      const double factor = a[row][column];
      for (std::size_t k = 0; k < 4; ++k) a[row][k] -= factor * a[column][k], b[row][k] -= factor * b[column][k];
    }
  }
  for (const auto& row : b)
    for (double v : row)
      if (!std::isfinite(v) || std::abs(v) > 1e30) return std::nullopt;
  if (is_affine()) b[3] = {0, 0, 0, 1};
  return result;
}

Transform::Transform(const Matrix4& matrix) {
  const auto inverse = matrix.inverse();
  if (!matrix.is_affine()) throw std::invalid_argument("the transform is not affine (its last row is not 0 0 0 1)");
  if (!inverse) throw std::invalid_argument("the transform is singular");
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      forward_[i][j] = static_cast<float>(matrix.m[i][j]);
      backward_[i][j] = static_cast<float>(inverse->m[i][j]);
    }
}

Bounds3 Transform::bounds(const Rows& r, const Bounds3& b) {
  Bounds3 result;
  if (b.empty()) return result;
  for (int corner = 0; corner < 8; ++corner)
    result.add(apply(
        r, {corner & 1 ? b.high.x : b.low.x, corner & 2 ? b.high.y : b.low.y, corner & 4 ? b.high.z : b.low.z}, 1));
  return result;
}

bool Transform::is_identity() const { return forward_ == kIdentity; }

bool Transform::swaps_handedness() const {
  const auto& f = forward_;
  const Vec3 x{f[0][0], f[1][0], f[2][0]}, y{f[0][1], f[1][1], f[2][1]}, z{f[0][2], f[1][2], f[2][2]};
  return dot(cross(x, y), z) < 0;
}

}  // namespace dspm
