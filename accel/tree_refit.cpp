// Takes a Tree over to shapes that have moved: the nodes stay, their boxes are those of what now lies below them.
#include <algorithm>
#include <optional>

#include "dspm/accel/placed_boxes.h"
#include "dspm/accel/tree.h"
#include "dspm/accel/tree_limits.h"
#include "dspm/base/system/parallel.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// Returns the packets' boxes.
std::vector<Bounds3> Tree::move_packets(std::span<const PlacedShape> shapes) {
  std::vector<Bounds3> boxes(packets_.size());
  parallel_for(static_cast<std::int64_t>(packets_.size()), 1 << 10, [&](std::int64_t p) {
    const auto number = static_cast<std::size_t>(p);
    TrianglePacket& packet = packets_[number];
    for (std::size_t lane = 0; lane < TrianglePacket::kSize && packet.shape[lane] >= 0; ++lane) {
      const int primitive = packet.primitive[lane], shape = packet.shape[lane];
      const TriangleMesh& mesh = *shapes[static_cast<std::size_t>(shape)].shape->triangles();
      packet.set(lane, shape, primitive, mesh.vertex(primitive, 0), mesh.vertex(primitive, 1),
                 mesh.vertex(primitive, 2));
      boxes[number].add(with_margin(mesh.bounds(primitive)));
    }
  });
  return boxes;
}

/// Returns the placed objects' boxes.
std::vector<Bounds3> Tree::move_placed(std::span<const PlacedShape> shapes, MeshTrees& meshes) {
  std::vector<std::optional<PlacedBoxes>> boxes_of(shapes.size());
  for (Placed& placed : placed_) {
    auto& boxes = boxes_of[static_cast<std::size_t>(placed.number)];
    placed.shape = &shapes[static_cast<std::size_t>(placed.number)];
    if (placed.mesh != nullptr) placed.mesh = &meshes.of(*placed.shape->shape);
    if (!boxes) boxes.emplace(*placed.shape);
    margins_ = std::max(margins_, boxes->margins());
  }
  std::vector<Bounds3> boxes(placed_.size());
  parallel_for(static_cast<std::int64_t>(placed_.size()), 1 << 10, [&](std::int64_t p) {
    const auto i = static_cast<std::size_t>(p);
    const PlacedBoxes& of = *boxes_of[static_cast<std::size_t>(placed_[i].number)];
    boxes[i] = placed_[i].mesh != nullptr ? of.of(placed_[i].mesh->outline()) : of.of_primitive(placed_[i].primitive);
  });
  return boxes;
}

Tree Tree::refitted(std::span<const PlacedShape> shapes, MeshTrees& meshes) const {
  Tree tree = *this;
  tree.margins_ = 1;
  if (cut_out_ != nullptr) tree.cut_out_ = shapes.data();
  const std::vector<Bounds3> of_packet = tree.move_packets(shapes), of_placed = tree.move_placed(shapes, meshes);
  const auto refit = [&](const auto& self, std::uint32_t child) -> Bounds3 {
    if (child >= Bvh::kLeaf + kPlaced) return of_placed[child - Bvh::kLeaf - kPlaced];
    Bounds3 box;
    if (child >= Bvh::kLeaf) {
      const std::size_t first = child & (kTwo - 1);
      box = of_packet[first];
      if ((child & kTwo) != 0) box.add(of_packet[first + 1]);
      return box;
    }
    Bvh::Node& node = tree.bvh_.nodes[child];
    for (std::size_t i = 0; i < Bvh::kWidth && node.planes[0][i] <= node.planes[1][i]; ++i) {
      const Bounds3 below = self(self, node.child[i]);
      node.set_box(i, below);
      box.add(below);
    }
    return box;
  };
  if (!tree.empty()) refit(refit, tree.bvh_.root);
  return tree;
}

}  // namespace dspm
