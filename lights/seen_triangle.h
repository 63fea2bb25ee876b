// A triangle as a point sees it: directions to it that are uniform by solid angle.
#pragma once

#include <array>

#include "dspm/base/math/vec.h"

namespace dspm {

class SeenTriangle {
 public:
  SeenTriangle(const std::array<Vec3, 3>& corners, const Vec3& from);

  /// Returns whether it is so near, for its size, that points uniform by area would be noisier.
  bool is_near() const { return near_; }
  /// In steradians; 0 if it is seen edge on, or if rounding leaves no digits of it.
  double solid_angle() const { return solid_angle_; }
  /// Returns the barycentric coordinates (b1, b2) of the point in a direction that is uniform by solid angle. Nearby
  /// numbers give nearby points. [Arvo 1995, Stratified Sampling of Spherical Triangles]
  Vec2 sample(Vec2 u) const;

 private:
  struct Direction {
    double x, y, z;
  };
  static double dot(const Direction& a, const Direction& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static Direction cross(const Direction& a, const Direction& b);
  static Direction sum(const Direction& a, double s, const Direction& b, double t);
  static Direction across(const Direction& v, const Direction& from);

  std::array<Direction, 3> to_;  // to the corners
  std::array<Direction, 3> w_;   // of length 1
  double solid_angle_ = 0;
  bool near_ = false;
};

}  // namespace dspm
