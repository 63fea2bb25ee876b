// A Bvh by Embree's builder: binned surface area heuristic on all threads, several times as fast as ours. Only the
// builder is Embree's. Its own rays decide by its own triangle test, which differs with the instruction set and may
// miss a triangle at its edge without a trace, so no answer of dspm's could rest on them.
#include <algorithm>
#include <memory>
#include <new>
#include <stdexcept>
#include <type_traits>

#include "dspm/accel/bvh.h"
#include "dspm/accel/embree.h"
#include "dspm/accel/embree_version.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/work.h"

namespace dspm {
namespace {

// Levels remain for leaves that are split into placed objects and triangles, and for the nodes of crowds.
constexpr unsigned kDepth = Bvh::kMaxDepth - 3;

/// Returns the device, which lives as long as the process: starting it takes a millisecond, longer than most trees.
RTCDevice device() {
  static const RTCDevice only = rtcNewDevice(nullptr);
  return only;
}

struct Release {
  void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

Bounds3 to_bounds(const RTCBounds& b) { return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}}; }

// What Embree makes; it lives in Embree's memory until the end.
struct Made {
  bool is_leaf;
  std::uint32_t count;
};
struct MadeLeaf : Made {
  std::uint32_t pieces[Bvh::kWidth];
  std::span<const std::uint32_t> all() const { return {pieces, count}; }
};
struct MadeNode : Made {
  const Made* children[Bvh::kWidth];
  Bounds3 bounds[Bvh::kWidth];
};

template <class T>
T* make(RTCThreadLocalAllocator memory, std::size_t count) {
  T* made = new (rtcThreadLocalAlloc(memory, sizeof(T), alignof(T))) T;
  made->is_leaf = std::is_same_v<T, MadeLeaf>, made->count = static_cast<std::uint32_t>(count);
  return made;
}

void* make_node(RTCThreadLocalAllocator memory, unsigned count, void*) {
  return static_cast<Made*>(make<MadeNode>(memory, count));
}
MadeNode& node_at(void* made) { return *static_cast<MadeNode*>(static_cast<Made*>(made)); }

void* make_leaf(RTCThreadLocalAllocator memory, const RTCBuildPrimitive* primitives, std::size_t count, void*) {
  auto* leaf = make<MadeLeaf>(memory, count);
  for (std::size_t i = 0; i < count; ++i) leaf->pieces[i] = primitives[i].primID;
  return static_cast<Made*>(leaf);
}

void set_children(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) node_at(node).children[i] = static_cast<const Made*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) node_at(node).bounds[i] = to_bounds(*bounds[i]);
}

/// Copies Embree's nodes into a Bvh.
class Copy {
 public:
  explicit Copy(std::span<const Piece> pieces) : pieces_(pieces) {}

  Bvh of(const Made& root) && {
    bvh_.nodes.reserve(root.is_leaf ? 1 : nodes_in(root));  // of many millions; a vector that grows copies them
    bvh_.order.reserve(pieces_.size());
    if (root.is_leaf)
      add_mixed(static_cast<const MadeLeaf&>(root).all());
    else
      add_node(static_cast<const MadeNode&>(root));
    return std::move(bvh_);
  }

 private:
  std::uint32_t add_node(const MadeNode& made) {
    const std::uint32_t number = new_node();
    for (std::uint32_t i = 0; i < made.count; ++i) set(number, i, made.bounds[i], add(*made.children[i]));
    return number;
  }

  std::uint32_t add(const Made& made) {
    if (!made.is_leaf) return add_node(static_cast<const MadeNode&>(made));
    const auto pieces = static_cast<const MadeLeaf&>(made).all();
    return is_one_leaf(pieces) ? add_leaf(pieces) : add_mixed(pieces);
  }

  std::size_t nodes_in(const Made& made) const {
    if (made.is_leaf) return is_one_leaf(static_cast<const MadeLeaf&>(made).all()) ? 0 : 1;
    std::size_t nodes = 1;
    for (std::uint32_t i = 0; i < made.count; ++i) nodes += nodes_in(*static_cast<const MadeNode&>(made).children[i]);
    return nodes;
  }

  bool is_one_leaf(std::span<const std::uint32_t> pieces) const {
    return pieces.size() == 1 || std::none_of(pieces.begin(), pieces.end(), [&](auto p) { return fills_leaf(p); });
  }
  bool fills_leaf(std::uint32_t piece) const { return pieces_[piece].size > 1; }

  std::uint32_t add_leaf(std::span<const std::uint32_t> pieces) {
    bvh_.leaves.push_back({static_cast<std::uint32_t>(bvh_.order.size()), static_cast<std::uint32_t>(pieces.size())});
    bvh_.order.insert(bvh_.order.end(), pieces.begin(), pieces.end());
    return Bvh::kLeaf + static_cast<std::uint32_t>(bvh_.leaves.size() - 1);
  }

  /// Adds a node for a leaf in which some pieces need a node of their own: to Embree, all are alike.
  std::uint32_t add_mixed(std::span<const std::uint32_t> pieces) {
    const std::uint32_t number = new_node();
    std::vector<std::uint32_t> small;
    Bounds3 bounds;
    std::size_t i = 0;
    for (const std::uint32_t& piece : pieces) {
      const Bounds3& box = pieces_[piece].bounds;
      if (fills_leaf(piece))
        set(number, i++, box, add_leaf(std::span(&piece, 1)));
      else
        small.push_back(piece), bounds.add(box);
    }
    if (!small.empty()) set(number, i, bounds, add_leaf(small));
    return number;
  }

  std::uint32_t new_node() {
    bvh_.nodes.push_back(Bvh::Node::empty());
    return static_cast<std::uint32_t>(bvh_.nodes.size() - 1);
  }

  void set(std::uint32_t number, std::size_t i, const Bounds3& box, std::uint32_t child) {
    bvh_.nodes[number].set_box(i, box);
    bvh_.nodes[number].child[i] = child;
  }

  std::span<const Piece> pieces_;
  Bvh bvh_;
};

UntouchedVector<RTCBuildPrimitive> primitives_of(std::span<const Piece> pieces) {
  UntouchedVector<RTCBuildPrimitive> primitives(pieces.size());
  parallel_for(static_cast<std::int64_t>(pieces.size()), 1 << 14, [&](std::int64_t i) {
    const auto number = static_cast<std::size_t>(i);
    const auto& [low, high] = pieces[number].bounds;
    primitives[number] = {low.x, low.y, low.z, 0, high.x, high.y, high.z, static_cast<unsigned>(number)};
  });
  return primitives;
}

}  // namespace

Bvh build_bvh_with_embree(std::span<const Piece> pieces, int leaf_size) {
  if (pieces.empty()) return {};
  const std::unique_ptr<RTCBVHTy, Release> bvh(device() ? rtcNewBVH(device()) : nullptr);
  if (!bvh)
    throw std::runtime_error("Embree does not start; Accelerator \"two-level\" \"string static\" \"own\" does without");
  UntouchedVector<RTCBuildPrimitive> primitives = primitives_of(pieces);
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxBranchingFactor = Bvh::kWidth;
  arguments.maxDepth = kDepth;
  arguments.sahBlockSize = arguments.maxLeafSize = static_cast<unsigned>(leaf_size);
  arguments.bvh = bvh.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = make_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = make_leaf;
  const void* root = [&] {
    const LibraryWork work(thread_count());
    return rtcBuildBVH(&arguments);
  }();
  if (!root) throw std::bad_alloc();
  return Copy(pieces).of(*static_cast<const Made*>(root));
}

std::string_view embree_version() { return RTC_VERSION_STRING; }

}  // namespace dspm
