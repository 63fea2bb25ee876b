#include "accel/triangle_tree.h"

namespace dspm {

TriangleTree::TriangleTree(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all) {
  struct Triangle {
    int shape, primitive;
  };
  std::vector<Triangle> triangles;
  std::vector<Piece> pieces;
  frames_.resize(shapes.size());
  for (const int s : which) {
    const PlacedShape& placed = shapes[static_cast<std::size_t>(s)];
    frames_[static_cast<std::size_t>(s)] = placed.frames;
    for (int p = 0; p < placed.shape->primitive_count(); ++p) {
      triangles.push_back({s, p});
      pieces.push_back({with_margin(placed.shape->bounds(p)), placed.frames});
    }
  }

  bvh_ = build_bvh(pieces, TrianglePacket::kSize, all);
  packets_.resize(bvh_.leaves.size());
  for (std::size_t leaf = 0; leaf < packets_.size(); ++leaf) {
    for (std::uint32_t i = 0; i < bvh_.leaves[leaf].count; ++i) {
      const Triangle t = triangles[bvh_.order[bvh_.leaves[leaf].first + i]];
      const TriangleMesh& mesh = *shapes[static_cast<std::size_t>(t.shape)].shape->triangles();
      packets_[leaf].add(t.shape, t.primitive, mesh.vertex(t.primitive, 0), mesh.vertex(t.primitive, 1),
                         mesh.vertex(t.primitive, 2));
    }
  }
  bvh_.forget_pieces();
}

}  // namespace dspm
