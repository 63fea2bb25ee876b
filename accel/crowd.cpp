#include "dspm/accel/crowd.h"

#include <algorithm>
#include <span>

#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

constexpr int kBlock = 1 << 11;
constexpr std::size_t kWidth = Bvh::kWidth;

/// Primitives of consecutive numbers, from which nodes are made: halved across the longest extent until a node takes
/// them.
class Block {
 public:
  struct Member {
    Vec3 twice_center;
    std::uint32_t number;  // within the block
  };

  Block(int first, int count, const std::function<Bounds3(int)>& box_of)
      : boxes_(static_cast<std::size_t>(count)), members_(boxes_.size()) {
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      boxes_[i] = box_of(first + static_cast<int>(i));
      members_[i] = {boxes_[i].low + boxes_[i].high, i};
    }
  }

  /// Calls fn(span of members) for each node. All but the last are full.
  template <class Fn>
  void for_each_node(const Fn& fn) {
    halve(members_, fn);
  }
  const Bounds3& box(const Member& member) const { return boxes_[member.number]; }

 private:
  template <class Fn>
  void halve(std::span<Member> part, const Fn& fn) {
    if (part.size() <= kWidth) return fn(part);
    const std::size_t nodes = (part.size() + kWidth - 1) / kWidth, left = (nodes + 1) / 2 * kWidth;
    const auto middle = part.begin() + static_cast<std::ptrdiff_t>(left);
    const auto halve_along = [&](auto coordinate) {
      std::nth_element(part.begin(), middle, part.end(), [&](const Member& a, const Member& b) {
        return a.twice_center.*coordinate < b.twice_center.*coordinate;
      });
    };
    switch (longest_axis(part)) {
      case 0: halve_along(&Vec3::x); break;
      case 1: halve_along(&Vec3::y); break;
      default: halve_along(&Vec3::z);
    }
    halve(part.first(left), fn);
    halve(part.subspan(left), fn);
  }

  static int longest_axis(std::span<const Member> part) {
    Bounds3 centers;
    for (const Member& member : part) centers.add(member.twice_center);
    const Vec3 extent = centers.extent();
    const int xy = extent.x > extent.y ? 0 : 1;
    return extent[xy] > extent.z ? xy : 2;
  }

  std::vector<Bounds3> boxes_;
  std::vector<Member> members_;
};

}  // namespace

/// Returns false if most blocks reach across most of the shape: numbers then say nothing about where primitives lie.
bool is_crowd(const Shape& shape) {
  constexpr int kFewest = 1 << 14, kStep = 32;
  constexpr float kMost = 0.7f;
  const int count = shape.primitive_count();
  if (count < kFewest || shape.triangles()) return false;
  std::vector<Bounds3> blocks(static_cast<std::size_t>(chunk_count(count, kBlock)));
  parallel_chunks(count, kBlock, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t p = begin; p < end; p += kStep)
      blocks[static_cast<std::size_t>(begin / kBlock)].add(shape.bounds(static_cast<int>(p)));
  });
  Bounds3 whole;
  float sum = 0;
  for (const Bounds3& block : blocks) whole.add(block), sum += block.half_area();
  return sum <= kMost * static_cast<float>(blocks.size()) * whole.half_area();
}

std::vector<Bounds3> add_crowd(int primitives, std::uint32_t first_leaf, const std::function<Bounds3(int)>& box_of,
                               Bvh::Nodes& nodes) {
  const std::size_t before = nodes.size(), added = static_cast<std::size_t>(chunk_count(primitives, Bvh::kWidth));
  std::vector<Bounds3> boxes(added);
  nodes.resize(before + added);
  parallel_chunks(primitives, kBlock, [&](std::int64_t begin, std::int64_t end) {
    const int first = static_cast<int>(begin);
    Block block(first, static_cast<int>(end - begin), box_of);
    std::size_t number = static_cast<std::size_t>(begin) / kWidth;
    block.for_each_node([&](std::span<const Block::Member> part) {
      Bvh::Node& node = nodes[before + number] = Bvh::Node::empty();
      for (std::size_t i = 0; i < part.size(); ++i) {
        node.set_box(i, block.box(part[i]));
        node.child[i] = Bvh::kLeaf + first_leaf + static_cast<std::uint32_t>(first) + part[i].number;
        boxes[number].add(block.box(part[i]));
      }
      ++number;
    });
  });
  return boxes;
}

}  // namespace dspm
