#include "dspm/accel/plain_trees.h"

#include <algorithm>

#include "dspm/accel/two_level.h"
#include "dspm/shapes/plain_shape.h"

namespace dspm {

int first_not_plain(std::span<const PlacedShape> shapes) {
  const auto is_plain = [](const PlacedShape& s) {
    return s.shape->triangles() != nullptr || s.shape->plain().has_value();
  };
  const auto found = std::ranges::find_if_not(shapes, is_plain);
  return found == shapes.end() ? -1 : static_cast<int>(found - shapes.begin());
}

PlainTrees::PlainTrees(const TwoLevel& trees) {
  query_.still = plain(trees.static_tree());
  query_.moving = plain(trees.dynamic_tree());
  for (const Tree& tree : trees.trees_of_frames()) of_frame_.push_back(plain(tree));
  if (!of_frame_.empty()) query_.of_frame = of_frame_.data(), query_.frame_count = of_frame_.size();
  query_.margins = std::max(query_.still.margins, query_.moving.margins);
}

PlainTree PlainTrees::plain(const Tree& tree) {
  if (tree.empty()) return {};
  const auto plain_of = [](const PlacedShape& shape, int number, int primitive) {
    PlainTree::Placed own;
    own.to_world = shape.to_world, own.in_object_space = shape.in_object_space();
    own.frames = shape.frames, own.number = number, own.primitive = primitive;
    return own;
  };
  std::vector<PlainTree::Placed>& placed = placed_.emplace_back();
  for (const Tree::Placed& p : tree.placed_) {
    PlainTree::Placed& own = placed.emplace_back(plain_of(*p.shape, p.number, p.primitive));
    if (p.mesh != nullptr)
      own.mesh = mesh(*p.mesh);
    else
      own.shape = *p.shape->shape->plain();
  }
  std::vector<PlainTree::Crowd>& crowds = crowds_.emplace_back();
  for (const Tree::PlacedCrowd& c : tree.crowds_) {
    crowds.push_back({c.first, plain_of(*c.shape, c.number, 0)});
    crowds.back().placed.shape = *c.shape->shape->plain();
  }
  return {.nodes = tree.bvh_.nodes.data(),
          .node_frames = tree.bvh_.node_frames.empty() ? nullptr : tree.bvh_.node_frames.data(),
          .packets = tree.packets_.data(),
          .placed = placed.data(),
          .crowds = crowds.data(),
          .frames = tree.frames_.data(),
          .root = tree.bvh_.root,
          .margins = tree.margins_,
          .node_count = tree.bvh_.nodes.size(),
          .packet_count = tree.packets_.size(),
          .placed_count = placed.size(),
          .crowd_count = crowds.size(),
          .shape_count = tree.frames_.size()};
}

const PlainTree* PlainTrees::mesh(const Tree& tree) {
  const auto [found, is_new] = meshes_.try_emplace(&tree);
  if (is_new) found->second = plain(tree);
  return &found->second;
}

}  // namespace dspm
