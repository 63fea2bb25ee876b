// A bilinear patch: the surface (1-u)(1-v) p00 + u(1-v) p10 + (1-u)v p01 + uv p11. Its four edges are straight.
#pragma once

#include <array>
#include <optional>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/shape.h"

namespace dspm {

struct BilinearPatch {
  Vec3 p00, p10, p01, p11;

  DoubleVec3 at(double u, double v) const;
  DoubleVec3 along_u(double v) const;  // the derivative
  DoubleVec3 along_v(double u) const;
  /// Returns along_u x along_v; zero in corners and along edges of length zero.
  DoubleVec3 normal(double u, double v) const { return cross(along_u(v), along_v(u)); }

  /// Returns the nearest hit with t in (0, ray.t_max). Watertight: a ray that passes through an edge that patches or
  /// triangles share hits at least one of them.
  std::optional<PrimitiveHit> intersect(const Ray& ray) const;
  /// Returns u and v of a point of the patch; nullopt if they cannot be found.
  std::optional<std::array<double, 2>> parameters(const Vec3& p) const;

  bool has_area() const;
  double area() const;
  /// Returns u and v of a point distributed uniformly over the area, and back.
  std::array<double, 2> uniform(Vec2 numbers) const;
  Vec2 uniform_numbers(double u, double v) const;
};

}  // namespace dspm
