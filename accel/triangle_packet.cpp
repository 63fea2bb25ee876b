#include "accel/triangle_packet.h"

#include "shapes/triangle_mesh.h"

namespace dspm {

Bounds3 TrianglePacket::bounds() const {
  Bounds3 all;
  for (unsigned rest = lanes; rest != 0; rest &= rest - 1) {
    Bounds3 triangle;
    for (int i = 0; i < 3; ++i) triangle.add(corner(i, static_cast<std::size_t>(std::countr_zero(rest))));
    all.add(with_margin(triangle));
  }
  return all;
}

namespace {

// A triangle that moves little keeps its place in a packet for up to 8 frames: as long as the box of the frames' union has
// at most so many times the area of one frame's box.
constexpr float kMostGrowth = 4;

struct Triangle {
  int shape, primitive;
};

/// Cuts the triangles into pieces: single ones, or one in consecutive frames.
class Cutter {
 public:
  explicit Cutter(std::span<const PlacedShape> shapes) : shapes_(shapes) {}

  /// The same primitive of meshes of the same topology, in the order of frames.
  void cut(std::span<const int> sequence, int primitive) {
    if (sequence.size() > TrianglePacket::kSize) return cut_in_two(sequence, primitive);
    Piece piece{{}, {}, static_cast<int>(sequence.size())};
    float area = 0;
    for (const int s : sequence) {
      const Bounds3 bounds = with_margin(shape(s).shape->bounds(primitive));
      piece.bounds.add(bounds), piece.frames |= shape(s).frames, area += bounds.half_area();
    }
    if (piece.size > 1 && piece.bounds.half_area() * static_cast<float>(piece.size) > kMostGrowth * area)
      return cut_in_two(sequence, primitive);
    pieces.push_back(piece);
    first_triangle.push_back(triangles.size());
    for (const int s : sequence) triangles.push_back({s, primitive});
  }

  std::vector<Piece> pieces;
  std::vector<std::size_t> first_triangle;  // by piece
  std::vector<Triangle> triangles;

 private:
  const PlacedShape& shape(int s) const { return shapes_[static_cast<std::size_t>(s)]; }
  void cut_in_two(std::span<const int> sequence, int primitive) {
    const std::size_t half = std::bit_floor(sequence.size() - 1);
    cut(sequence.first(half), primitive);
    cut(sequence.subspan(half), primitive);
  }

  std::span<const PlacedShape> shapes_;
};

/// How many of the shapes, from the first on, are meshes with the same faces.
std::size_t sequence_length(std::span<const PlacedShape> shapes, std::span<const int> which) {
  const auto faces = [&](std::size_t i) -> const std::vector<Face>& {
    return shapes[static_cast<std::size_t>(which[i])].shape->triangles()->faces();
  };
  std::size_t length = 1;
  while (length < which.size() && faces(length) == faces(0)) ++length;
  return length;
}

}  // namespace

PackedTriangles::PackedTriangles(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all) {
  Cutter cutter(shapes);
  while (!which.empty()) {
    const std::size_t length = sequence_length(shapes, which);
    const int count = shapes[static_cast<std::size_t>(which.front())].shape->primitive_count();
    for (int p = 0; p < count; ++p) cutter.cut(which.first(length), p);
    which = which.subspan(length);
  }

  bvh = build_bvh(cutter.pieces, TrianglePacket::kSize, all);
  packets.resize(bvh.leaves.size());
  for (std::size_t leaf = 0; leaf < packets.size(); ++leaf) {
    for (std::uint32_t i = 0; i < bvh.leaves[leaf].count; ++i) {
      const std::uint32_t piece = bvh.order[bvh.leaves[leaf].first + i];
      const auto first = cutter.first_triangle[piece], end = first + static_cast<std::size_t>(cutter.pieces[piece].size);
      for (std::size_t t = first; t < end; ++t) {
        const auto [shape, number] = cutter.triangles[t];
        const TriangleMesh& mesh = *shapes[static_cast<std::size_t>(shape)].shape->triangles();
        packets[leaf].add(shape, number, mesh.vertex(number, 0), mesh.vertex(number, 1), mesh.vertex(number, 2));
      }
    }
  }
  bvh.forget_pieces();
}

}  // namespace dspm
