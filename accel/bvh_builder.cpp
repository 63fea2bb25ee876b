// Builds a Bvh top down: a node's range of pieces is cut into 8 ranges, always cutting the range with the largest box
// at the best split of a binned surface area heuristic. The result depends only on the order of the pieces.
#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "dspm/accel/bvh.h"
#include "dspm/base/math/frames.h"

namespace dspm {
namespace {

constexpr int kBins = 32;
// Below this level pieces are only halved, so that no input makes the tree deeper than Bvh::kMaxDepth.
constexpr int kFreeLevels = 48;
// The assumed fraction of rays in all frames; the others are assumed to be in one.
constexpr float kShareOfFullRays = 0.5f;

struct Range {
  std::uint32_t first = 0, count = 0;
  std::int64_t size = 0;  // of all pieces
  Bounds3 bounds, centers;
  FrameSet frames;
};

class Builder {
 public:
  Builder(std::span<const Piece> pieces, int leaf_size, FrameSet frames)
      : pieces_(pieces), leaf_size_(leaf_size), all_frames_(frames) {
    bvh_.order.resize(pieces.size());
    std::iota(bvh_.order.begin(), bvh_.order.end(), 0u);
  }

  Bvh build() && {
    if (pieces_.empty()) return std::move(bvh_);
    add_node(range(0, static_cast<std::uint32_t>(pieces_.size())), 0);
    return std::move(bvh_);
  }

 private:
  struct Bin {
    Bounds3 bounds;
    FrameSet frames;
    std::int64_t size = 0;

    void add(const Bin& o) { bounds.add(o.bounds), frames |= o.frames, size += o.size; }
  };
  using Bins = std::array<Bin, kBins>;
  /// Pieces below bin `at` go to the left; axis 3 is time: the lowest frame.
  struct Split {
    float cost = kInfinity;
    int axis = -1, at = 0;
  };

  const Piece& piece(std::uint32_t place) const { return pieces_[bvh_.order[place]]; }

  /// Returns the expected cost of leaves, without the nodes above them.
  float cost(const Bin& bin) const {
    const float share = static_cast<float>(bin.frames.count()) / static_cast<float>(std::max(1, all_frames_.count()));
    const float chance = bin.bounds.half_area() * (kShareOfFullRays + (1 - kShareOfFullRays) * share);
    return chance * static_cast<float>((bin.size + leaf_size_ - 1) / leaf_size_);
  }

  Range range(std::uint32_t first, std::uint32_t count) const {
    Range r;
    r.first = first, r.count = count;
    for (std::uint32_t i = first; i < first + count; ++i) {
      r.bounds.add(piece(i).bounds);
      r.centers.add(piece(i).bounds.center());
      r.frames |= piece(i).frames;
      r.size += piece(i).size;
    }
    return r;
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
    Split best;
    for (int axis = 0; axis < 4; ++axis) {
      if (bin_of(r, axis, piece(r.first)) < 0) continue;
      Bins bins;
      for (std::uint32_t i = r.first; i < r.first + r.count; ++i) {
        const Piece& p = piece(i);
        bins[static_cast<std::size_t>(bin_of(r, axis, p))].add({p.bounds, p.frames, p.size});
      }
      consider(bins, axis, best);
    }
    return best;
  }

  void consider(const Bins& bins, int axis, Split& best) const {
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
    const auto begin = bvh_.order.begin() + r.first, end = begin + r.count;
    const Split split = free ? best_split(r) : Split{};
    auto middle = begin + r.count / 2;
    if (split.axis >= 0)
      middle =
          std::partition(begin, end, [&](std::uint32_t p) { return bin_of(r, split.axis, pieces_[p]) < split.at; });
    const auto count = static_cast<std::uint32_t>(middle - begin);
    return {range(r.first, count), range(r.first + count, r.count - count)};
  }

  std::uint32_t add_node(const Range& all, int level) {
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

    const auto number = static_cast<std::uint32_t>(bvh_.nodes.size());
    bvh_.nodes.push_back(Bvh::Node::empty());
    bvh_.node_frames.emplace_back();
    for (std::size_t i = 0; i < size; ++i) bvh_.nodes.back().set_box(i, children[i].bounds);
    for (std::size_t i = 0; i < size; ++i) {
      const Range& r = children[i];
      const std::uint32_t child = r.size <= leaf_size_ ? add_leaf(r) : add_node(r, level + 1);
      bvh_.nodes[number].child[i] = child;
      bvh_.node_frames[number][i] = r.frames;
    }
    return number;
  }

  std::uint32_t add_leaf(const Range& r) {
    bvh_.leaves.push_back({r.first, r.count});
    return Bvh::kLeaf + static_cast<std::uint32_t>(bvh_.leaves.size() - 1);
  }

  std::span<const Piece> pieces_;
  int leaf_size_;
  FrameSet all_frames_;
  Bvh bvh_;
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
