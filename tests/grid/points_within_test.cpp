// Every distance test that this processor can do against a plain loop.
#include "dspm/base/grid/points_within.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace dspm {
namespace {

class PointsWithinTest : public ::testing::TestWithParam<DistanceTest> {};

TEST_P(PointsWithinTest, FindsWhatAPlainLoopFinds) {
  if (!is_supported(GetParam())) GTEST_SKIP() << "not on this processor";
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(0, 1);
  constexpr std::uint32_t kCount = 700;
  std::vector<float> x(kCount + PointsWithin::kPadding), y(x.size()), z(x.size());
  for (auto* coordinates : {&x, &y, &z})
    for (float& c : *coordinates) c = unit(random);
  const Vec3 p{.4f, .5f, .6f};
  for (const float radius2 : {0.f, .05f, .3f, 4.f})
    for (std::uint32_t begin = 0; begin < 40; ++begin)
      for (const std::uint32_t end : {begin, begin + 1, begin + 17, begin + 300, kCount}) {
        using Found = std::vector<std::pair<std::uint32_t, float>>;
        Found expected, found;
        for (std::uint32_t i = begin; i < end; ++i) {
          const float dx = x[i] - p.x, dy = y[i] - p.y, dz = z[i] - p.z, d2 = dx * dx + dy * dy + dz * dz;
          if (d2 <= radius2) expected.emplace_back(i, d2);
        }
        PointsWithin within(p, radius2, GetParam());
        const auto take = [&](std::uint32_t i, float d2) { found.emplace_back(i, d2); };
        for (std::uint32_t i = begin; i < end;) {
          i = within.add(x.data(), y.data(), z.data(), i, end);
          if (within.full()) within.empty_into(take);
        }
        within.empty_into(take);
        EXPECT_EQ(found, expected);
      }
}

INSTANTIATE_TEST_SUITE_P(Widths, PointsWithinTest,
                         ::testing::Values(DistanceTest::four_lanes, DistanceTest::sixteen_lanes));

}  // namespace
}  // namespace dspm
