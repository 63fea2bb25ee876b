// Four triangles side by side, of which a leaf holds up to two packets. find_in_packet.h tests a ray against them.
#pragma once

#include <cstddef>

#include "dspm/base/math/vec.h"

namespace dspm {

struct alignas(16) TrianglePacket {
  static constexpr int kSize = 4;
  /// By corner, axis and triangle.
  using Vertices = float[3][3][kSize];

  Vertices vertex;
  int shape[kSize] = {-1, -1, -1, -1};  // those of unused places stay negative
  int primitive[kSize];

  void set(std::size_t lane, int to_shape, int number, const Vec3& p0, const Vec3& p1, const Vec3& p2) {
    const Vec3 corners[3] = {p0, p1, p2};
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis) vertex[corner][axis][lane] = corners[corner][axis];
    shape[lane] = to_shape;
    primitive[lane] = number;
  }
  constexpr Vec3 corner(std::size_t lane, int corner) const {
    return {vertex[corner][0][lane], vertex[corner][1][lane], vertex[corner][2][lane]};
  }
};

/// The most triangles that a leaf holds.
inline constexpr int kLeafSize = 2 * TrianglePacket::kSize;

}  // namespace dspm
