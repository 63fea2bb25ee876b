// The grid against a double loop, on random clouds of every shape.
#include "dspm/base/grid/point_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

namespace dspm {
namespace {

std::vector<Vec3> cloud(std::mt19937& random, std::size_t count, const Vec3& extent, const Vec3& offset) {
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = offset + extent * Vec3{unit(random), unit(random), unit(random)};
  return points;
}

std::vector<std::uint32_t> by_double_loop(const std::vector<Vec3>& points, const Vec3& p, float radius) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Vec3 d = points[i] - p;
    if (d.x * d.x + d.y * d.y + d.z * d.z <= radius * radius) found.push_back(i);
  }
  return found;
}

TEST(PointGrid, FindsWhatADoubleLoopFinds) {
  std::mt19937 random(1);
  const Vec3 extents[] = {{1, 1, 1}, {100, 1, 0.01f}, {5, 0, 5}, {0, 0, 0}, {1e-5f, 1e5f, 1}};
  for (const Vec3& extent : extents)
    for (const float cell : {1e-3f, 0.1f, 10.f}) {
      const std::vector<Vec3> points = cloud(random, 2000, extent, {-3, 40, 0.5f});
      PointGrid grid;
      grid.build(points, cell);
      for (const Vec3& p : cloud(random, 40, extent * 1.5f, {-3.2f, 39.9f, 0.4f}))
        for (const float radius : {0.01f, 0.3f, 50.f}) {
          std::vector<std::uint32_t> found;
          const std::uint64_t tested = grid.for_each_within(
              p, radius * radius, [&](std::uint32_t i, float) { found.push_back(grid.order()[i]); });
          std::sort(found.begin(), found.end());
          EXPECT_EQ(found, by_double_loop(points, p, radius));
          EXPECT_GE(tested, found.size());
          EXPECT_LE(tested, points.size());
        }
    }
}

TEST(PointGrid, KeepsTheOrderWithinACell) {
  std::mt19937 random(2);
  const std::vector<Vec3> points = cloud(random, 500, {1, 1, 1}, {});
  PointGrid grid;
  grid.build(points, 100.f);  // one cell
  for (std::uint32_t i = 0; i < points.size(); ++i) EXPECT_EQ(grid.order()[i], i);
}

TEST(PointGrid, RebuildsAndEmpties) {
  std::mt19937 random(3);
  PointGrid grid;
  grid.build(cloud(random, 100, {1, 1, 1}, {}), 0.1f);
  grid.build({}, 0.1f);
  EXPECT_EQ(grid.for_each_within({}, 100, [](std::uint32_t, float) { FAIL(); }), 0u);
  grid.build(cloud(random, 10, {1, 1, 1}, {}), 0.1f);
  int found = 0;
  grid.for_each_within({}, 100, [&](std::uint32_t, float) { ++found; });
  EXPECT_EQ(found, 10);
}

// Nothing is allocated: the points are not looked at.
TEST(PointGrid, RefusesMorePointsThanItCanNumber) {
  const Vec3 only{};
  PointGrid grid;
  EXPECT_THROW(grid.build(std::span(&only, PointGrid::kMostPoints + 1), 1), std::length_error);
  EXPECT_GE(PointGrid::kMostPoints, 4'000'000'000u);
}

// 8 cells a point would be more than 2^32 from 537 million points on.
TEST(PointGrid, CellsHaveNumbersOf32Bits) {
  EXPECT_EQ(PointGrid::most_cells(1), 4096u);
  EXPECT_EQ(PointGrid::most_cells(500'000'000), 4'000'000'000u);
  for (const std::size_t points : {std::size_t{537'000'000}, std::size_t{4'000'000'000}})
    EXPECT_EQ(PointGrid::most_cells(points), PointGrid::kMostPoints);
}

}  // namespace
}  // namespace dspm
