#include "bench/measure/noise.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/bench/grey_image.h"

namespace dspm {
namespace noise_test {

TEST(RelativeSquare, IsRelativeAndAtMostOne) {
  const Image truth = grey_image({1, 1, 1, 1});  // the floor is 0.01
  EXPECT_EQ(relative_square(truth, truth, truth), 0);
  EXPECT_NEAR(relative_square(grey_image({1.101f, 1, 1, 1}), truth, truth), 0.0025, 1e-6);
  EXPECT_NEAR(relative_square(grey_image({1000, 1, 1, 1}), truth, truth), 0.25, 1e-6);
}

TEST(RelativeSquare, CountsDarkPixelsAgainstAHundredthOfTheMean) {
  const Image truth = grey_image({0, 2});
  EXPECT_NEAR(relative_square(grey_image({0.005f, 2}), truth, truth), 0.125, 1e-6);
  EXPECT_EQ(relative_square(grey_image({0, 0}), grey_image({0, 0}), grey_image({0, 0})), 0);
}

TEST(RelativeSquare, SeesChannelsThatKeepTheLuminance) {
  const Image truth = grey_image({1});
  Image tinted = truth;
  tinted.pixels[0] = Rgb(1.101f, 1, 1);
  EXPECT_NEAR(relative_square(tinted, truth, truth), 0.01 / 3, 1e-6);
}

TEST(RelativeSquare, OfTwoRunsIsTwiceTheVariance) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal(1, 0.1f);
  Image truth(200, 200), a = truth, b = truth;
  for (std::size_t p = 0; p < truth.pixels.size(); ++p) {
    truth.pixels[p] = Rgb(1, 1, 1);
    a.pixels[p] = Rgb(normal(random), normal(random), normal(random));
    b.pixels[p] = Rgb(normal(random), normal(random), normal(random));
  }
  EXPECT_NEAR(relative_square(a, b, truth), 2 * 0.01 / (1.01 * 1.01), 4e-4);
}

}  // namespace noise_test
}  // namespace dspm
