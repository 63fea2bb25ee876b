// Crowds: every primitive lies in one node, and what is scattered is left to the builders.
#include "dspm/accel/crowd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dspm {
namespace {

constexpr std::uint32_t kFirst = 100;

/// Of unit cubes in a row.
std::vector<Bounds3> row(int count) {
  std::vector<Bounds3> boxes;
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  return boxes;
}

std::vector<Bounds3> crowd_of(const std::vector<Bounds3>& boxes, Bvh::Nodes& nodes) {
  return add_crowd(
      static_cast<int>(boxes.size()), kFirst, [&](int i) { return boxes[static_cast<std::size_t>(i)]; }, nodes);
}

TEST(Crowd, HasEveryPrimitiveOnce) {
  std::vector<Bounds3> primitives = row(kCrowd + 13);
  for (std::size_t i = 0; i + 100 < primitives.size(); i += 100)  // neighbours in any order
    std::shuffle(primitives.begin() + static_cast<std::ptrdiff_t>(i),
                 primitives.begin() + static_cast<std::ptrdiff_t>(i + 100), std::mt19937(static_cast<unsigned>(i)));
  Bvh::Nodes nodes(3, Bvh::Node::empty());
  const std::vector<Bounds3> boxes = crowd_of(primitives, nodes);
  ASSERT_EQ(boxes.size(), kCrowd / 8 + 2);
  ASSERT_EQ(nodes.size(), boxes.size() + 3);
  std::vector<int> seen(primitives.size());
  float length = 0;
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    const std::vector<Bounds3> inside = nodes[n + 3].boxes();
    Bounds3 all;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const std::uint32_t number = nodes[n + 3].child[i] - Bvh::kLeaf - kFirst;
      ASSERT_LT(number, primitives.size());
      ++seen[number];
      EXPECT_EQ(inside[i].low, primitives[number].low);
      EXPECT_EQ(inside[i].high, primitives[number].high);
      all.add(inside[i]);
    }
    EXPECT_EQ(boxes[n].low, all.low);
    EXPECT_EQ(boxes[n].high, all.high);
    length += all.extent().x;
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
  EXPECT_LT(length, 1.1f * static_cast<float>(primitives.size()));  // no node reaches across others
}

TEST(Crowd, IsNoneIfPrimitivesAreScattered) {
  std::vector<Bounds3> primitives = row(kCrowd);
  std::shuffle(primitives.begin(), primitives.end(), std::mt19937(1));
  Bvh::Nodes nodes(3, Bvh::Node::empty());
  EXPECT_TRUE(crowd_of(primitives, nodes).empty());
  EXPECT_EQ(nodes.size(), 3u);
}

}  // namespace
}  // namespace dspm
