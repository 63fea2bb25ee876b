// Meshes cut into pieces for building a tree: single triangles, or one triangle in several frames.
#pragma once

#include <cstdint>
#include <span>

#include "dspm/accel/bvh.h"
#include "dspm/accel/triangle_packet.h"
#include "dspm/base/system/untouched.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

struct TrianglePieces {
  struct Triangle {
    int shape, primitive;
  };

  /// Makes pieces of the meshes shapes[i] for all i in `which`; ignores their to_world.
  TrianglePieces(std::span<const PlacedShape> shapes, std::span<const int> which);

  std::size_t count() const { return first_triangle.size() - 1; }
  std::span<const Triangle> of_piece(std::size_t p) const {
    return std::span(triangles).subspan(first_triangle[p], first_triangle[p + 1] - first_triangle[p]);
  }

  UntouchedVector<Piece> pieces;
  UntouchedVector<std::uint32_t> first_triangle;  // by piece, and one past the last
  UntouchedVector<Triangle> triangles;

 private:
  void add_each(int shape, const PlacedShape& placed);
  void add_cut(std::span<const PlacedShape> shapes, std::span<const int> sequence);
};

}  // namespace dspm
