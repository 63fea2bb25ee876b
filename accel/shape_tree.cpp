#include "accel/shape_tree.h"

namespace dspm {

ShapeTree::ShapeTree(const Shape& shape) : shape_(shape) {
  const FrameSet only = FrameSet::single(0);
  if (shape.triangles()) {
    const PlacedShape placed{.shape = &shape, .to_world = {}, .frames = only};
    const int first = 0;
    triangles_.emplace(std::span(&placed, 1), std::span(&first, 1), only);
    return;
  }
  std::vector<Piece> pieces;
  for (int p = 0; p < shape.primitive_count(); ++p) pieces.push_back({with_margin(shape.bounds(p)), only});
  others_ = build_bvh(pieces, 1, only);
}

template <class Query>
void ShapeTree::find(const Ray& ray, Query& query) const {
  if (triangles_) {
    triangles_->find(MeshRay(ray), query);
    return;
  }
  walk(others_, BoxRay(ray), query, [&](std::uint32_t leaf) {
    const auto primitive = static_cast<int>(others_.order[others_.leaves[leaf].first]);
    if (const auto hit = meet(shape_, primitive, ray)) query.offer({hit->t, 0, primitive, hit->uv}, query.frames());
  });
}
template void ShapeTree::find(const Ray&, NearestHit&) const;
template void ShapeTree::find(const Ray&, Unblocked&) const;

std::vector<Bounds3> ShapeTree::outline() const {
  const Bvh& bvh = triangles_ ? triangles_->bvh() : others_;
  return bvh.nodes.empty() ? std::vector<Bounds3>{} : bvh.nodes.front().boxes();
}

}  // namespace dspm
