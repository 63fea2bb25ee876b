// Affine placements. The language composes Matrix4 (double); Transform (float, with its inverse) transforms rays and
// shapes.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// Row-major 4 x 4 matrix; points are columns: p' = M p.
struct Matrix4 {
  std::array<std::array<double, 4>, 4> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

  static Matrix4 translate(double x, double y, double z);
  static Matrix4 scale(double x, double y, double z);
  /// Rotates by an angle in degrees around the axis, which need not be of unit length but must not be zero.
  static Matrix4 rotate(double degrees, double x, double y, double z);
  /// Maps the world to the camera, left-handed, as in pbrt's LookAt; nullopt if the three do not span a view.
  static std::optional<Matrix4> look_at(const std::array<double, 3>& eye, const std::array<double, 3>& look,
                                        const std::array<double, 3>& up);
  /// Reads the matrix column by column, as pbrt writes it.
  static Matrix4 from_columns(const std::array<double, 16>& values);

  /// Returns nullopt if the matrix is singular, or so nearly singular that the inverse is not finite.
  std::optional<Matrix4> inverse() const;
  bool is_affine() const { return m[3][0] == 0 && m[3][1] == 0 && m[3][2] == 0 && m[3][3] == 1; }
  friend Matrix4 operator*(const Matrix4& a, const Matrix4& b);
  friend bool operator==(const Matrix4&, const Matrix4&) = default;
};

/// An invertible affine map between an object's space and the world.
class Transform {
 public:
  Transform() = default;
  /// Throws std::invalid_argument if `matrix` is not affine or is singular.
  explicit Transform(const Matrix4& matrix);

  constexpr Vec3 point(const Vec3& p) const { return apply(forward_, p, 1); }
  constexpr Vec3 vector(const Vec3& v) const { return apply(forward_, v, 0); }
  /// The result is not normalised and stays on the same side of the surface.
  constexpr Vec3 normal(const Vec3& n) const { return apply_transposed(backward_, n); }
  constexpr Vec3 inverse_point(const Vec3& p) const { return apply(backward_, p, 1); }
  constexpr Vec3 inverse_normal(const Vec3& n) const { return apply_transposed(forward_, n); }
  constexpr Vec3 inverse_vector(const Vec3& v) const { return apply(backward_, v, 0); }
  /// The ray in the object's space. Its direction keeps the scale, so distances t are the world's.
  constexpr Ray inverse_ray(const Ray& ray) const {
    return {inverse_point(ray.origin), inverse_vector(ray.direction), ray.t_max};
  }
  Bounds3 bounds(const Bounds3& b) const { return bounds(forward_, b); }
  Bounds3 inverse_bounds(const Bounds3& b) const { return bounds(backward_, b); }
  /// An upper bound on the rounding error of point(p), per coordinate.
  constexpr Vec3 point_error(const Vec3& p) const {
    constexpr float gamma3 = 3 * 0x1p-24f / (1 - 3 * 0x1p-24f);
    const auto of_row = [&](const std::array<float, 4>& r) {
      return gamma3 * (std::abs(r[0] * p.x) + std::abs(r[1] * p.y) + std::abs(r[2] * p.z) + std::abs(r[3]));
    };
    return {of_row(forward_[0]), of_row(forward_[1]), of_row(forward_[2])};
  }
  bool is_identity() const;
  /// Returns whether it mirrors: whether it turns a right-handed frame into a left-handed one.
  bool swaps_handedness() const;
  friend bool operator==(const Transform&, const Transform&) = default;

 private:
  using Rows = std::array<std::array<float, 4>, 3>;
  static constexpr Rows kIdentity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  static constexpr Vec3 apply(const Rows& r, const Vec3& v, float w) {
    return {r[0][0] * v.x + r[0][1] * v.y + r[0][2] * v.z + r[0][3] * w,
            r[1][0] * v.x + r[1][1] * v.y + r[1][2] * v.z + r[1][3] * w,
            r[2][0] * v.x + r[2][1] * v.y + r[2][2] * v.z + r[2][3] * w};
  }
  static Bounds3 bounds(const Rows& r, const Bounds3& b);
  static constexpr Vec3 apply_transposed(const Rows& r, const Vec3& v) {
    return {r[0][0] * v.x + r[1][0] * v.y + r[2][0] * v.z, r[0][1] * v.x + r[1][1] * v.y + r[2][1] * v.z,
            r[0][2] * v.x + r[1][2] * v.y + r[2][2] * v.z};
  }

  Rows forward_ = kIdentity, backward_ = kIdentity;
};

}  // namespace dspm
