// Meshes cut into what a tree is built over: single triangles, or one triangle in several frames.
#pragma once

#include "accel/triangle_packet.h"
#include "shapes/placed_shape.h"

namespace dspm {

struct TrianglePieces {
  struct Triangle {
    int shape, primitive;
  };

  /// Of shapes[i] for all i in `which`: meshes, whose to_world is not looked at.
  TrianglePieces(std::span<const PlacedShape> shapes, std::span<const int> which);

  std::span<const Triangle> of_piece(std::size_t p) const {
    return std::span(triangles).subspan(first_triangle[p], static_cast<std::size_t>(pieces[p].size));
  }

  std::vector<Piece> pieces;
  std::vector<std::size_t> first_triangle;  // by piece
  std::vector<Triangle> triangles;
};

}  // namespace dspm
