// Crowds: every primitive lies in one node, and what is scattered is no crowd.
#include "dspm/accel/crowd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dspm {
namespace {

constexpr std::uint32_t kFirst = 100;

constexpr int kMany = 20'000;

/// Unit cubes in a row.
std::vector<Bounds3> row(int count) {
  std::vector<Bounds3> boxes;
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  return boxes;
}

class Boxes final : public Shape {
 public:
  explicit Boxes(std::vector<Bounds3> boxes) : boxes_(std::move(boxes)) {}
  int primitive_count() const override { return static_cast<int>(boxes_.size()); }
  Bounds3 bounds(int primitive) const override { return boxes_[static_cast<std::size_t>(primitive)]; }
  std::optional<PrimitiveHit> intersect(int, const Ray&) const override { return std::nullopt; }
  SurfacePoint surface_point(int, Vec2) const override { return {}; }
  float area(int) const override { return 0; }
  Vec2 sample_area(int, Vec2 u) const override { return u; }

 private:
  std::vector<Bounds3> boxes_;
};

TEST(Crowd, HasEveryPrimitiveOnce) {
  std::vector<Bounds3> primitives = row(kMany + 13);
  for (std::size_t i = 0; i + 100 < primitives.size(); i += 100)  // neighbours in any order
    std::shuffle(primitives.begin() + static_cast<std::ptrdiff_t>(i),
                 primitives.begin() + static_cast<std::ptrdiff_t>(i + 100), std::mt19937(static_cast<unsigned>(i)));
  Bvh::Nodes nodes(3, Bvh::Node::empty());
  const Boxes shape(primitives);
  EXPECT_TRUE(is_crowd(shape));
  const std::vector<Bounds3> boxes = add_crowd(
      shape.primitive_count(), kFirst, [&](int i) { return shape.bounds(i); }, nodes);
  ASSERT_EQ(boxes.size(), kMany / 8 + 2);
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

TEST(Crowd, IsNoShapeOfScatteredOrFewPrimitives) {
  std::vector<Bounds3> primitives = row(kMany);
  std::shuffle(primitives.begin(), primitives.end(), std::mt19937(1));
  EXPECT_FALSE(is_crowd(Boxes(primitives)));
  EXPECT_FALSE(is_crowd(Boxes(row(100))));
}

}  // namespace
}  // namespace dspm
