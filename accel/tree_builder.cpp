// Builds a Tree: pieces of all that it holds, nodes over them, and what lies in the leaves.
#include <algorithm>
#include <utility>

#include "dspm/accel/crowd.h"
#include "dspm/accel/placed_boxes.h"
#include "dspm/accel/tree.h"
#include "dspm/accel/tree_limits.h"
#include "dspm/accel/triangle_pieces.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {
namespace {

// From here on, Embree's builder is faster, even as it starts its threads.
constexpr std::size_t kManyPieces = 5000;

}  // namespace

class Tree::Builder {
 public:
  Builder(Tree& tree, std::span<const PlacedShape> shapes, MeshTrees& meshes)
      : tree_(tree), shapes_(shapes), meshes_(meshes) {}

  void build(std::span<const int> which, FrameSet all, BvhBuilder builder) {
    std::vector<int> world_meshes;
    for (const int s : which)
      if (is_world_mesh(shape(s))) world_meshes.push_back(s);
    TrianglePieces triangles(shapes_, world_meshes);
    pieces_ = std::move(triangles.pieces);
    std::vector<int> crowds;
    for (const int s : which) {
      if (is_world_mesh(shape(s))) continue;
      if (!has_own_tree(shape(s)) && is_crowd(*shape(s).shape))
        crowds.push_back(s);
      else
        place(s);
    }
    first_of_crowds_ = pieces_.size();
    place_crowds(crowds);
    expect_numbered(pieces_.size(), placed_.size());

    const bool alike =
        std::all_of(pieces_.begin(), pieces_.end(), [&](const Piece& p) { return p.frames.contains(all); });
    if (builder == BvhBuilder::by_size) builder = pieces_.size() < kManyPieces ? BvhBuilder::own : BvhBuilder::embree;
    Bvh above = alike && builder == BvhBuilder::embree ? build_bvh_with_embree(pieces_, kLeafSize)
                                                       : build_bvh(pieces_, kLeafSize, all);
    pieces_ = {};  // frees memory for the packets
    const std::vector<std::uint32_t> places = fill_leaves(above, triangles);
    const auto below = static_cast<std::uint32_t>(tree_.bvh_.nodes.size());
    parallel_for(static_cast<std::int64_t>(above.nodes.size()), 1 << 12, [&](std::int64_t n) {
      for (std::uint32_t& child : above.nodes[static_cast<std::size_t>(n)].child)
        child = child < Bvh::kLeaf ? below + child : places[child - Bvh::kLeaf];
    });
    put_above_crowds(std::move(above), alike);
  }

 private:
  const PlacedShape& shape(int s) const { return shapes_[static_cast<std::size_t>(s)]; }

  void place(int s) {
    const PlacedShape& placed = shape(s);
    const PlacedBoxes boxes(placed);
    tree_.margins_ = std::max(tree_.margins_, boxes.margins());
    if (has_own_tree(placed)) {
      const Tree& mesh = meshes_.of(*placed.shape);
      placed_.push_back({&placed, &mesh, s, 0});
      pieces_.push_back({boxes.of(mesh.outline()), placed.frames, kLeafSize});
      return;
    }
    add_primitives(placed, s, boxes);
  }

  void add_primitives(const PlacedShape& placed, int s, const PlacedBoxes& boxes) {
    const int count = placed.shape->primitive_count();
    const std::size_t first_piece = pieces_.size(), first_placed = placed_.size();
    pieces_.resize(first_piece + static_cast<std::size_t>(count));
    placed_.resize(first_placed + static_cast<std::size_t>(count));
    const auto add_one = [&](std::int64_t p) {
      const auto i = static_cast<std::size_t>(p);
      placed_[first_placed + i] = {&placed, nullptr, s, static_cast<int>(p)};
      pieces_[first_piece + i] = {boxes.of_primitive(static_cast<int>(p)), placed.frames, kLeafSize};
    };
    parallel_for(count, 1 << 12, add_one);
  }

  /// Places crowds. Their nodes get room for those above them, of which there are fewer than a quarter as many.
  void place_crowds(std::span<const int> crowds) {
    const auto count = [&](int s) { return static_cast<std::size_t>(shape(s).shape->primitive_count()); };
    std::size_t all = 0;
    for (const int s : crowds) all += count(s);
    expect_numbered(all, all);
    tree_.bvh_.nodes.reserve(all / Bvh::kWidth * 5 / 4);
    std::uint32_t first = 0;
    for (const int s : crowds) {
      const PlacedShape& placed = shape(s);
      const PlacedBoxes boxes(placed);
      tree_.margins_ = std::max(tree_.margins_, boxes.margins());
      tree_.crowds_.push_back({first, &placed, s});
      const auto box_of = [&](int p) { return boxes.of_primitive(p); };
      for (const Bounds3& box :
           add_crowd(placed.shape->primitive_count(), kOfCrowd + first, box_of, tree_.bvh_.nodes)) {
        pieces_.push_back({box, placed.frames, kLeafSize});
        crowd_frames_.push_back(placed.frames);
      }
      first += static_cast<std::uint32_t>(count(s));
    }
  }

  /// Returns the children that leaves become, by their numbers: packets of triangles, placed objects, nodes of crowds.
  std::vector<std::uint32_t> fill_leaves(const Bvh& above, const TrianglePieces& triangles) {
    std::vector<std::uint32_t> places;
    places.reserve(above.leaves.size()), tree_.placed_.reserve(placed_.size());
    std::vector<std::uint8_t> packets_of_leaf(above.leaves.size());
    parallel_for(static_cast<std::int64_t>(above.leaves.size()), 1 << 10, [&](std::int64_t l) {
      const Bvh::Leaf& leaf = above.leaves[static_cast<std::size_t>(l)];
      if (above.order[leaf.first] < std::min(first_of_crowds_, triangles.count()))
        packets_of_leaf[static_cast<std::size_t>(l)] =
            static_cast<std::uint8_t>(packets_of(pieces_in(above, leaf), triangles));
    });
    std::size_t packets = 0;
    for (std::size_t l = 0; l < above.leaves.size(); ++l) {
      const std::size_t first = above.order[above.leaves[l].first];
      if (first >= first_of_crowds_) {
        places.push_back(static_cast<std::uint32_t>(first - first_of_crowds_));
      } else if (first >= triangles.count()) {
        places.push_back(Bvh::kLeaf + kPlaced + static_cast<std::uint32_t>(tree_.placed_.size()));
        tree_.placed_.push_back(placed_[first - triangles.count()]);
      } else {
        const std::size_t count = packets_of_leaf[l];
        places.push_back(Bvh::kLeaf + (count == 2 ? kTwo : 0) + static_cast<std::uint32_t>(packets));
        packets += count;
      }
    }
    expect_numbered(triangles.count(), packets);
    tree_.packets_.resize(packets);
    parallel_for(static_cast<std::int64_t>(places.size()), 1 << 10, [&](std::int64_t l) {
      const std::uint32_t place = places[static_cast<std::size_t>(l)];
      if (place >= Bvh::kLeaf && place < Bvh::kLeaf + kPlaced)
        fill(&tree_.packets_[place & (kTwo - 1)], pieces_in(above, above.leaves[static_cast<std::size_t>(l)]),
             triangles);
    });
    return places;
  }

  static std::span<const std::uint32_t> pieces_in(const Bvh& above, const Bvh::Leaf& leaf) {
    return std::span(above.order).subspan(leaf.first, leaf.count);
  }

  static std::size_t packets_of(std::span<const std::uint32_t> pieces, const TrianglePieces& triangles) {
    std::size_t count = 0;
    for (const std::uint32_t piece : pieces) count += triangles.of_piece(piece).size();
    return (count + TrianglePacket::kSize - 1) / TrianglePacket::kSize;
  }

  void fill(TrianglePacket* packets, std::span<const std::uint32_t> pieces, const TrianglePieces& triangles) const {
    std::size_t count = 0;
    for (const std::uint32_t piece : pieces) {
      for (const auto [s, number] : triangles.of_piece(piece)) {
        TrianglePacket& packet = packets[count / TrianglePacket::kSize];
        const std::size_t lane = count++ % TrianglePacket::kSize;
        if (lane == 0) packet = {};
        const TriangleMesh& mesh = *shape(s).shape->triangles();
        packet.set(lane, s, number, mesh.vertex(number, 0), mesh.vertex(number, 1), mesh.vertex(number, 2));
      }
    }
  }

  void put_above_crowds(Bvh above, bool alike) {
    Bvh& all = tree_.bvh_;
    all.root = static_cast<std::uint32_t>(all.nodes.size());
    if (all.nodes.empty()) {
      all.nodes = std::move(above.nodes);
      all.nodes.shrink_to_fit();
    } else {
      all.nodes.reserve(all.nodes.size() + above.nodes.size());
      all.nodes.insert(all.nodes.end(), above.nodes.begin(), above.nodes.end());
    }
    if (alike) return;
    if (crowd_frames_.empty()) return void(all.node_frames = std::move(above.node_frames));
    for (const FrameSet frames : crowd_frames_) all.node_frames.emplace_back().fill(frames);
    all.node_frames.insert(all.node_frames.end(), above.node_frames.begin(), above.node_frames.end());
  }

  Tree& tree_;
  std::span<const PlacedShape> shapes_;
  MeshTrees& meshes_;
  UntouchedVector<Piece> pieces_;  // triangles, then placed_, then the nodes of crowds
  std::vector<Placed> placed_;
  std::vector<FrameSet> crowd_frames_;  // by their nodes
  std::size_t first_of_crowds_ = 0;
};

Tree::Tree(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all, BvhBuilder builder,
           MeshTrees& meshes) {
  for (const PlacedShape& placed : shapes) frames_.push_back(placed.frames);
  Builder(*this, shapes, meshes).build(which, all, builder);
  for (const int s : which) {
    const PlacedShape& placed = shapes[static_cast<std::size_t>(s)];
    if (is_world_mesh(placed) && placed.cutout != nullptr) cut_out_ = shapes.data();
  }
}

}  // namespace dspm
