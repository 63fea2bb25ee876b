#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "bench/measure/convergence.h"
#include "tests/bench/grey_image.h"

namespace dspm {
namespace {

Images image_of(std::initializer_list<float> greys) { return {grey_image(greys)}; }

TEST(SpreadFrames, LeavesSomeOutEvenly) {
  std::vector<Frame> frames(32);
  std::iota(frames.begin(), frames.end(), 0);
  EXPECT_EQ(spread_frames(frames, 4), (std::vector<Frame>{0, 8, 16, 24}));
  EXPECT_EQ(spread_frames(frames, 99), frames);
  const std::vector<Frame> most = spread_frames(frames, 24);
  ASSERT_EQ(most.size(), 24u);
  for (std::size_t i = 1; i < most.size(); ++i) EXPECT_LE(most[i] - most[i - 1], 2);
}

TEST(Median, IsTheMiddleOrTheMeanOfTwo) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(median({}), 0);
}

TEST(Error, IsRelativeAndAtMostOneAPixel) {
  const Images truth = image_of({1, 1, 1, 1});  // the floor is 0.01
  EXPECT_EQ(error_of(truth, truth), 0);
  EXPECT_NEAR(error_of(image_of({1.101f, 1, 1, 1}), truth), 0.025, 1e-5);
  EXPECT_NEAR(error_of(image_of({1000, 1, 1, 1}), truth), 0.25, 1e-5);
  EXPECT_NEAR(error_of(image_of({0, 0, 0, 0}), truth), 1 / 1.01, 1e-5);
}

TEST(Error, CountsDarkPixelsAgainstAHundredthOfTheMean) {
  const Images truth = image_of({0, 2});
  EXPECT_NEAR(error_of(image_of({0.005f, 2}), truth), 0.25, 1e-4);
  EXPECT_EQ(error_of(image_of({0, 0}), image_of({0, 0})), 0);
}

TEST(Curve, FollowsAPowerLawBetweenItsPoints) {
  std::vector<ErrorPoint> curve;
  for (const int n : {1, 4, 16, 64}) curve.push_back({n, 0.1 * n, 1 / std::sqrt(n)});
  EXPECT_NEAR(time_to(curve, 1 / std::sqrt(32.)), 3.2, 1e-9);
  EXPECT_NEAR(time_to(curve, 0.5), 0.4, 1e-9);
  EXPECT_EQ(time_to(curve, 0.01), 0);
  EXPECT_EQ(time_to(curve, 2), 0.1);
  EXPECT_NEAR(error_after(curve, 3.2), 1 / std::sqrt(32.), 1e-9);
  EXPECT_EQ(error_after(curve, 100), 0.125);
  EXPECT_EQ(error_after(curve, 0.01), 1);
}

}  // namespace
}  // namespace dspm
