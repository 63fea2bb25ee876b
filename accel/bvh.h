// A bounding volume hierarchy over anything that has a box and a set of frames: 8-wide nodes, built by the surface area
// heuristic (bvh_builder.cpp, embree_builder.cpp), traversed by traverse.h. It knows neither shapes nor what its leaves
// hold.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/untouched.h"

namespace dspm {

/// An element that a tree is built over. `bounds` must have its margin (box_ray.h) and be finite.
struct Piece {
  Bounds3 bounds;
  FrameSet frames;
  int size = 1;  // leaf capacity that it uses
};

struct Bvh {
  static constexpr int kWidth = 8;
  /// Child numbers from here on are leaves.
  static constexpr std::uint32_t kLeaf = 1u << 31;
  /// Nodes on the longest path from the root to a leaf.
  static constexpr int kMaxDepth = 64;

  /// Boxes of the children: low and high x, low and high y, low and high z. Unused children have empty boxes, come
  /// last, and are never hit.
  struct alignas(32) Node {
    float planes[6][kWidth];
    std::uint32_t child[kWidth];

    static Node empty();
    void set_box(std::size_t i, const Bounds3& box);
    std::vector<Bounds3> boxes() const;
  };
  using Nodes = UntouchedVector<Node>;
  /// The union of the pieces' frames, by child.
  using NodeFrames = std::array<FrameSet, kWidth>;
  /// The pieces order[first], ..., order[first + count - 1].
  struct Leaf {
    std::uint32_t first, count;
  };

  Nodes nodes;             // empty if there are no pieces
  std::uint32_t root = 0;  // those before it are below it
  UntouchedVector<NodeFrames> node_frames;
  UntouchedVector<Leaf> leaves;
  std::vector<std::uint32_t> order;  // piece numbers

  const Node& root_node() const { return nodes[root]; }
  std::size_t memory() const {
    return nodes.capacity() * sizeof(Node) + node_frames.capacity() * sizeof(NodeFrames) +
           leaves.capacity() * sizeof(Leaf) + order.capacity() * sizeof(std::uint32_t);
  }
};

/// Builds a tree. A leaf holds pieces of total size up to `leaf_size`, at the cost of one test. `frames` are all that
/// rays may query.
Bvh build_bvh(std::span<const Piece> pieces, int leaf_size, FrameSet frames);

/// Builds a tree by Embree's builder, on all threads, for pieces of the same frames; Bvh::node_frames stays empty.
/// Pieces have size 1 or `leaf_size`. The order of leaves may differ from run to run; no answer depends on it.
Bvh build_bvh_with_embree(std::span<const Piece> pieces, int leaf_size);

/// The builder of a tree; by_size takes Embree's for many pieces.
enum class BvhBuilder { by_size, own, embree };

}  // namespace dspm
