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

PackedTriangles::PackedTriangles(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all) {
  struct Triangle {
    int shape, primitive;
  };
  std::vector<Triangle> triangles;
  std::vector<Piece> pieces;
  for (const int s : which) {
    const PlacedShape& placed = shapes[static_cast<std::size_t>(s)];
    for (int p = 0; p < placed.shape->primitive_count(); ++p) {
      triangles.push_back({s, p});
      pieces.push_back({with_margin(placed.shape->bounds(p)), placed.frames});
    }
  }

  bvh = build_bvh(pieces, TrianglePacket::kSize, all);
  packets.resize(bvh.leaves.size());
  for (std::size_t leaf = 0; leaf < packets.size(); ++leaf) {
    for (std::uint32_t i = 0; i < bvh.leaves[leaf].count; ++i) {
      const auto [shape, number] = triangles[bvh.order[bvh.leaves[leaf].first + i]];
      const TriangleMesh& mesh = *shapes[static_cast<std::size_t>(shape)].shape->triangles();
      packets[leaf].add(shape, number, mesh.vertex(number, 0), mesh.vertex(number, 1), mesh.vertex(number, 2));
    }
  }
  bvh.forget_pieces();
}

}  // namespace dspm
