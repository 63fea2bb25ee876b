#include "dspm/accel/crowd.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

#include "dspm/system/parallel.h"

namespace dspm {
namespace {

constexpr int kBlock = 1 << 11;
constexpr std::size_t kWidth = Bvh::kWidth;

/// Primitives of consecutive numbers, from which nodes are made: halved across the longest extent until a node takes them.
class Block {
 public:
  Block(int first, int count, const std::function<Bounds3(int)>& box_of) : count_(static_cast<std::size_t>(count)) {
    for (int i = 0; i < count; ++i) boxes_[static_cast<std::size_t>(i)] = box_of(first + i);
    std::iota(order_.begin(), order_.end(), std::uint16_t{0});
  }

  /// Calls fn(numbers within the block) for each node. All but the last are full.
  template <class Fn>
  void for_each_node(const Fn& fn) {
    halve(std::span(order_).first(count_), fn);
  }
  const Bounds3& box(std::uint16_t number) const { return boxes_[number]; }

 private:
  template <class Fn>
  void halve(std::span<std::uint16_t> part, const Fn& fn) {
    if (part.size() <= kWidth) return fn(part);
    const std::size_t nodes = (part.size() + kWidth - 1) / kWidth, left = (nodes + 1) / 2 * kWidth;
    const int axis = longest_axis(part);
    const auto twice_center = [&](std::uint16_t i) { return boxes_[i].low[axis] + boxes_[i].high[axis]; };
    std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(left), part.end(),
                     [&](std::uint16_t a, std::uint16_t b) { return twice_center(a) < twice_center(b); });
    halve(part.first(left), fn);
    halve(part.subspan(left), fn);
  }

  int longest_axis(std::span<const std::uint16_t> part) const {
    Bounds3 centers;
    for (const std::uint16_t i : part) centers.add(boxes_[i].center());
    const Vec3 extent = centers.extent();
    const int xy = extent.x > extent.y ? 0 : 1;
    return extent[xy] > extent.z ? xy : 2;
  }

  std::size_t count_;
  std::array<Bounds3, kBlock> boxes_;
  std::array<std::uint16_t, kBlock> order_;
};

/// Whether most blocks reach across most of the shape: then numbers say nothing about where primitives lie.
bool are_mixed(const std::vector<Bounds3>& blocks) {
  constexpr float kMost = 0.7f;
  Bounds3 whole;
  float sum = 0;
  for (const Bounds3& block : blocks) whole.add(block), sum += block.half_area();
  return sum > kMost * static_cast<float>(blocks.size()) * whole.half_area();
}

}  // namespace

std::vector<Bounds3> add_crowd(int primitives, std::uint32_t first_leaf, const std::function<Bounds3(int)>& box_of,
                               Bvh::Nodes& nodes) {
  const std::size_t before = nodes.size(), added = static_cast<std::size_t>(chunk_count(primitives, Bvh::kWidth));
  std::vector<Bounds3> boxes(added), blocks(static_cast<std::size_t>(chunk_count(primitives, kBlock)));
  nodes.resize(before + added);
  parallel_chunks(primitives, kBlock, [&](std::int64_t begin, std::int64_t end) {
    const int first = static_cast<int>(begin);
    Block block(first, static_cast<int>(end - begin), box_of);
    std::size_t number = static_cast<std::size_t>(begin) / kWidth;
    block.for_each_node([&](std::span<const std::uint16_t> part) {
      Bvh::Node& node = nodes[before + number] = Bvh::Node::empty();
      for (std::size_t i = 0; i < part.size(); ++i) {
        node.set_box(i, block.box(part[i]));
        node.child[i] = Bvh::kLeaf + first_leaf + static_cast<std::uint32_t>(first + part[i]);
        boxes[number].add(block.box(part[i]));
      }
      blocks[static_cast<std::size_t>(begin / kBlock)].add(boxes[number]);
      ++number;
    });
  });
  if (!are_mixed(blocks)) return boxes;
  nodes.resize(before);
  return {};
}

}  // namespace dspm
