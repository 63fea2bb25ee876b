#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "bench/measure/convergence.h"
#include "bench/measure/work.h"
#include "tests/bench/grey_image.h"

namespace dspm {
namespace measure_test {

Images image_of(std::initializer_list<float> greys) { return {grey_image(greys)}; }

TEST(SpreadFrames, LeavesSomeOutEvenly) {
  std::vector<FileFrame> frames(32);
  std::iota(frames.begin(), frames.end(), FileFrame(0));
  EXPECT_EQ(spread_frames(frames, 4), (std::vector{FileFrame(0), FileFrame(8), FileFrame(16), FileFrame(24)}));
  EXPECT_EQ(spread_frames(frames, 99), frames);
  const std::vector<FileFrame> most = spread_frames(frames, 24);
  ASSERT_EQ(most.size(), 24u);
  for (std::size_t i = 1; i < most.size(); ++i) EXPECT_LE(most[i].index() - most[i - 1].index(), 2);
}

// Of three kinds of work a, b, c that take 1, 2 and 3 seconds a piece, 4 separate runs do 10, 20, 30 each and all
// together 20, 40, 20: 4 (10 + 40 + 90) / (20 + 80 + 60) = 3.5, below 6, the factor of the third kind.
TEST(SharingFactors, AreThoseOfTheKindThatIsSharedMost) {
  const StepWork separate = {{{10}, {8}, {0}, {10, 20, 30}}}, together = {{{20}, {32}, {0}, {20, 40, 20}}};
  EXPECT_EQ(sharing_factors(separate, 4, together), (StepSeconds{2, 1, 0, 6, 0}));
}

TEST(OwnFile, ChoosesTheLampThatIsOn) {
  const std::filesystem::path file = std::filesystem::path(DSPM_SOURCE_DIR) / "bench/eight_lamps.dsc";
  const auto chances = [](const LoadedScene& loaded) {
    std::vector<float> all;
    for (const SceneLight& light : loaded.world->scene(loaded.job.frames)->lights) all.push_back(light.probability);
    return all;
  };
  EXPECT_EQ(chances(load(file)), std::vector<float>(8, 0.125f));
  const LoadedScene own = load(file, Choices{}, FileFrame(2));
  EXPECT_EQ(own.job.frames, std::vector{FileFrame(0)});
  EXPECT_EQ(own.job.variation(FileFrame(0)), "c");
  EXPECT_EQ(chances(own), std::vector<float>{1}) << "it has no other lamp";
}

// The ball's frames: a floor of 4 x 4 and a wall of 2, and the ball of radius 0.6 at 0.6 to 20.
TEST(OwnFile, HasTheSphereOfItsFrame) {
  const std::filesystem::path file = std::filesystem::path(DSPM_SOURCE_DIR) / "bench/rising_ball.dsc";
  const auto radius = [](const LoadedScene& loaded) { return loaded.world->scene(loaded.job.frames)->radius; };
  EXPECT_NEAR(radius(load(file)), std::sqrt(4 + 4 + 10.3f * 10.3f), 1e-3f);
  EXPECT_NEAR(radius(load(file, Choices{}, FileFrame(0))), 3, 1e-3f);
  EXPECT_NEAR(radius(load(file, Choices{}, FileFrame(23))), std::sqrt(4 + 4 + 10.3f * 10.3f), 1e-3f);
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

}  // namespace measure_test
}  // namespace dspm
