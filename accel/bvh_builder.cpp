// Builds a Bvh top down: a node's range of pieces is cut into 8 ranges, always cutting the range with the largest box
// at the best split of a binned surface area heuristic. The result depends only on the order of the pieces: sums over
// many of them are boxes, sets and whole numbers, which are the same however they are shared out among threads.
#include <algorithm>
#include <bit>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "dspm/accel/bvh.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/untouched.h"

namespace dspm {
namespace {

constexpr int kBins = 32;
// Below this level pieces are only halved, so that no input makes the tree deeper than Bvh::kMaxDepth.
constexpr int kFreeLevels = 48;
// The assumed fraction of rays in all frames; the others are assumed to be in one.
constexpr float kShareOfFullRays = 0.5f;
constexpr std::uint32_t kAtOnce = 1 << 12;  // pieces that are worth no second thread

struct Range {
  std::uint32_t first = 0, count = 0;
  std::int64_t size = 0;  // of all pieces
  Bounds3 bounds, centers;
  FrameSet frames;

  Range& operator+=(const Range& o) {
    count += o.count, size += o.size, bounds.add(o.bounds), centers.add(o.centers), frames |= o.frames;
    return *this;
  }
};

/// A node, which comes first, and what is below it. Children are numbered within it.
struct Subtree {
  Bvh::Nodes nodes;
  UntouchedVector<Bvh::NodeFrames> node_frames;
  UntouchedVector<Bvh::Leaf> leaves;

  std::uint32_t add_leaf(const Range& r) {
    leaves.push_back({r.first, r.count});
    return Bvh::kLeaf + static_cast<std::uint32_t>(leaves.size() - 1);
  }
  void resize(std::size_t node_count, std::size_t leaf_count) {
    nodes.resize(node_count), node_frames.resize(node_count), leaves.resize(leaf_count);
  }
  /// Copies another subtree to this place.
  void put(const Subtree& o, std::uint32_t node, std::uint32_t leaf) {
    for (std::size_t n = 0; n < o.nodes.size(); ++n) {
      Bvh::Node& to = nodes[node + n] = o.nodes[n];
      for (std::uint32_t& child : to.child) child += child < Bvh::kLeaf ? node : leaf;
    }
    std::copy(o.node_frames.begin(), o.node_frames.end(), node_frames.begin() + node);
    std::copy(o.leaves.begin(), o.leaves.end(), leaves.begin() + leaf);
  }
};

class Builder {
 public:
  Builder(std::span<const Piece> pieces, int leaf_size, FrameSet frames)
      : pieces_(pieces), leaf_size_(leaf_size), all_frames_(frames), order_(pieces.size()) {
    if (pieces.size() > kAtOnce) room_.resize(pieces.size());
    std::iota(order_.begin(), order_.end(), 0u);
  }

  Bvh build() && {
    Subtree all;
    if (!pieces_.empty()) add_node(all, range(0, static_cast<std::uint32_t>(pieces_.size())), 0);
    Bvh bvh;
    bvh.nodes = std::move(all.nodes), bvh.node_frames = std::move(all.node_frames);
    bvh.leaves = std::move(all.leaves), bvh.order = std::move(order_);
    return bvh;
  }

 private:
  struct Bin {
    Bounds3 bounds;
    FrameSet frames;
    std::int64_t size = 0;

    void add(const Bin& o) { bounds.add(o.bounds), frames |= o.frames, size += o.size; }
  };
  struct Bins {
    std::array<std::array<Bin, kBins>, 4> of_axis;

    Bins& operator+=(const Bins& o) {
      for (std::size_t axis = 0; axis < of_axis.size(); ++axis)
        for (std::size_t at = 0; at < kBins; ++at) of_axis[axis][at].add(o.of_axis[axis][at]);
      return *this;
    }
  };
  /// Pieces below bin `at` go to the left; axis 3 is time: the lowest frame.
  struct Split {
    float cost = kInfinity;
    int axis = -1, at = 0;
  };

  const Piece& piece(std::uint32_t place) const { return pieces_[order_[place]]; }

  /// Returns the sum of what sum_of(first place, end) returns for parts of these places.
  template <class SumOf>
  static auto sum_over(std::uint32_t first, std::uint32_t count, SumOf&& sum_of) {
    if (count <= kAtOnce) return sum_of(first, first + count);
    std::vector<decltype(sum_of(first, first))> parts(static_cast<std::size_t>(chunk_count(count, kAtOnce)));
    parallel_chunks(count, kAtOnce, [&](std::int64_t begin, std::int64_t end) {
      parts[static_cast<std::size_t>(begin / kAtOnce)] =
          sum_of(first + static_cast<std::uint32_t>(begin), first + static_cast<std::uint32_t>(end));
    });
    for (std::size_t i = 1; i < parts.size(); ++i) parts[0] += parts[i];
    return parts[0];
  }

  /// Returns the expected cost of leaves, without the nodes above them.
  float cost(const Bin& bin) const {
    const float share = static_cast<float>(bin.frames.count()) / static_cast<float>(std::max(1, all_frames_.count()));
    const float chance = bin.bounds.half_area() * (kShareOfFullRays + (1 - kShareOfFullRays) * share);
    return chance * static_cast<float>((bin.size + leaf_size_ - 1) / leaf_size_);
  }

  Range range(std::uint32_t first, std::uint32_t count) const {
    return sum_over(first, count, [&](std::uint32_t begin, std::uint32_t end) {
      Range r;
      r.first = begin;
      for (std::uint32_t i = begin; i < end; ++i) {
        const Piece& p = piece(i);
        r.bounds.add(p.bounds), r.centers.add(p.bounds.center());
        r.frames |= p.frames, r.size += p.size, ++r.count;
      }
      return r;
    });
  }

  /// Returns the bin of a piece along an axis; -1 if all pieces of the range would fall into the same bin.
  int bin_of(const Range& r, int axis, const Piece& p) const {
    if (axis == 3) {
      const int low = r.frames.lowest(), high = kMaxFrames - std::countl_zero(r.frames.bits());
      return high - low < 2 ? -1 : (p.frames.lowest() - low) * kBins / (high - low);
    }
    const float extent = r.centers.high[axis] - r.centers.low[axis];
    const float scale = static_cast<float>(kBins) / extent;
    if (!(extent > 0) || !(scale < kInfinity)) return -1;
    return std::min(kBins - 1, static_cast<int>((p.bounds.center()[axis] - r.centers.low[axis]) * scale));
  }

  Split best_split(const Range& r) const {
    const Bins bins = sum_over(r.first, r.count, [&](std::uint32_t begin, std::uint32_t end) {
      Bins some{};
      for (int axis = 0; axis < 4; ++axis) {
        if (bin_of(r, axis, piece(r.first)) < 0) continue;
        for (std::uint32_t i = begin; i < end; ++i) {
          const Piece& p = piece(i);
          some.of_axis[static_cast<std::size_t>(axis)][static_cast<std::size_t>(bin_of(r, axis, p))].add(
              {p.bounds, p.frames, p.size});
        }
      }
      return some;
    });
    Split best;
    for (int axis = 0; axis < 4; ++axis)
      if (bin_of(r, axis, piece(r.first)) >= 0) consider(bins.of_axis[static_cast<std::size_t>(axis)], axis, best);
    return best;
  }

  void consider(const std::array<Bin, kBins>& bins, int axis, Split& best) const {
    std::array<float, kBins> right_cost{};
    Bin right, left;
    for (std::size_t at = kBins - 1; at > 0; --at) {
      right.add(bins[at]);
      right_cost[at] = right.size == 0 ? kInfinity : cost(right);
    }
    for (std::size_t at = 1; at < kBins; ++at) {
      left.add(bins[at - 1]);
      const float both = left.size == 0 ? kInfinity : cost(left) + right_cost[at];
      if (both < best.cost) best = {both, axis, static_cast<int>(at)};
    }
  }

  std::array<Range, 2> cut(const Range& r, bool free) {
    const Split split = free ? best_split(r) : Split{};
    std::uint32_t count = r.count / 2;
    if (split.axis >= 0)
      count = partition(r, [&](std::uint32_t p) { return bin_of(r, split.axis, pieces_[p]) < split.at; });
    return {range(r.first, count), range(r.first + count, r.count - count)};
  }

  /// Moves the pieces of the left part before the others; returns how many they are.
  template <class IsLeft>
  std::uint32_t partition(const Range& r, IsLeft&& is_left) {
    const auto begin = order_.begin() + r.first;
    if (r.count <= kAtOnce) return static_cast<std::uint32_t>(std::partition(begin, begin + r.count, is_left) - begin);
    std::vector<std::uint32_t> left(static_cast<std::size_t>(chunk_count(r.count, kAtOnce)));
    parallel_chunks(r.count, kAtOnce, [&](std::int64_t first, std::int64_t end) {
      left[static_cast<std::size_t>(first / kAtOnce)] =
          static_cast<std::uint32_t>(std::count_if(begin + first, begin + end, is_left));
    });
    std::uint32_t count = 0;
    for (std::uint32_t& of_part : left) of_part = std::exchange(count, count + of_part);
    const auto room = room_.begin() + r.first;
    parallel_chunks(r.count, kAtOnce, [&](std::int64_t first, std::int64_t end) {
      const std::uint32_t before = left[static_cast<std::size_t>(first / kAtOnce)];
      std::partition_copy(begin + first, begin + end, room + before,
                          room + count + static_cast<std::uint32_t>(first) - before, is_left);
    });
    parallel_chunks(r.count, kAtOnce,
                    [&](std::int64_t first, std::int64_t end) { std::copy(room + first, room + end, begin + first); });
    return count;
  }

  std::uint32_t add_node(Subtree& tree, const Range& all, int level) {
    const bool free = level < kFreeLevels;
    std::array<Range, Bvh::kWidth> children{all};
    std::size_t size = 1;
    while (size < children.size()) {
      const auto weight = [&](const Range& r) {
        return r.size <= leaf_size_ ? -1.f : free ? r.bounds.half_area() : static_cast<float>(r.count);
      };
      const auto widest = std::max_element(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(size),
                                           [&](const Range& a, const Range& b) { return weight(a) < weight(b); });
      if (widest->size <= leaf_size_) break;
      const auto [left, right] = cut(*widest, free);
      *widest = left;
      children[size++] = right;
    }

    const auto number = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.push_back(Bvh::Node::empty());
    tree.node_frames.push_back({});
    for (std::size_t i = 0; i < size; ++i) {
      tree.nodes.back().set_box(i, children[i].bounds);
      tree.node_frames.back()[i] = children[i].frames;
    }
    const auto some = std::span(children).first(size);
    if (all.count > kAtOnce) {
      add_below(tree, number, some, level);
    } else {
      for (std::size_t i = 0; i < size; ++i) {
        const Range& r = some[i];
        const std::uint32_t child = r.size <= leaf_size_ ? tree.add_leaf(r) : add_node(tree, r, level + 1);
        tree.nodes[number].child[i] = child;
      }
    }
    return number;
  }

  /// Adds what is below a node, the last so far, on many threads.
  void add_below(Subtree& tree, std::uint32_t number, std::span<const Range> children, int level) {
    std::vector<Subtree> below(children.size());
    parallel_for(static_cast<std::int64_t>(children.size()), 1, [&](std::int64_t i) {
      const auto at = static_cast<std::size_t>(i);
      if (children[at].size > leaf_size_) add_node(below[at], children[at], level + 1);
    });
    std::vector<std::uint32_t> first_node, first_leaf;
    auto nodes = static_cast<std::uint32_t>(tree.nodes.size()), leaves = static_cast<std::uint32_t>(tree.leaves.size());
    for (std::size_t i = 0; i < children.size(); ++i) {
      Subtree& part = below[i];
      const bool is_leaf = part.nodes.empty();
      if (is_leaf) part.add_leaf(children[i]);
      tree.nodes[number].child[i] = is_leaf ? Bvh::kLeaf + leaves : nodes;
      first_node.push_back(std::exchange(nodes, nodes + static_cast<std::uint32_t>(part.nodes.size())));
      first_leaf.push_back(std::exchange(leaves, leaves + static_cast<std::uint32_t>(part.leaves.size())));
    }
    tree.resize(nodes, leaves);
    parallel_for(static_cast<std::int64_t>(children.size()), 1, [&](std::int64_t i) {
      const auto at = static_cast<std::size_t>(i);
      tree.put(std::exchange(below[at], {}), first_node[at], first_leaf[at]);
    });
  }

  std::span<const Piece> pieces_;
  int leaf_size_;
  FrameSet all_frames_;
  std::vector<std::uint32_t> order_;     // piece numbers
  UntouchedVector<std::uint32_t> room_;  // for the order of large ranges
};

}  // namespace

Bvh::Node Bvh::Node::empty() {
  Node node{};
  for (std::size_t i = 0; i < kWidth; ++i) node.set_box(i, {});
  return node;
}

void Bvh::Node::set_box(std::size_t i, const Bounds3& box) {
  for (int axis = 0; axis < 3; ++axis) {
    planes[2 * axis][i] = box.low[axis];
    planes[2 * axis + 1][i] = box.high[axis];
  }
}

std::vector<Bounds3> Bvh::Node::boxes() const {
  std::vector<Bounds3> all;
  for (int i = 0; i < kWidth; ++i) {
    const Bounds3 box{{planes[0][i], planes[2][i], planes[4][i]}, {planes[1][i], planes[3][i], planes[5][i]}};
    if (!box.empty()) all.push_back(box);
  }
  return all;
}

Bvh build_bvh(std::span<const Piece> pieces, int leaf_size, FrameSet frames) {
  return Builder(pieces, leaf_size, frames).build();
}

}  // namespace dspm
