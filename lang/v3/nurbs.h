// Non-uniform rational B-splines.
#pragma once

#include <span>
#include <vector>

#include "dspm/base/math/vec.h"

namespace dspm::v3 {

/// One of the two directions of a surface. There are count + order knots; they do not descend.
struct KnotVector {
  int count, order;  // of control points; degree + 1, from 2 to count
  std::vector<float> knots;

  float first() const { return knots[static_cast<std::size_t>(order) - 1]; }
  float last() const { return knots[static_cast<std::size_t>(count)]; }
};

struct SplinePoint {
  Vec3 p, by_u, by_v;
};

class NurbsSurface {
 public:
  /// Takes control points with weights, w x, w y, w z, w; u runs fastest.
  NurbsSurface(KnotVector u, KnotVector v, std::vector<float> points)
      : u_(std::move(u)), v_(std::move(v)), points_(std::move(points)) {}

  /// Evaluates the surface; u and v must be within the knots' first() and last().
  SplinePoint at(float u, float v) const;

 private:
  KnotVector u_, v_;
  std::vector<float> points_;
};

}  // namespace dspm::v3
