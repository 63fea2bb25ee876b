// The update rule against numbers worked out by hand from [WG12 (1)-(5)].
#include "dspm/integrators/methods/pixel_statistics.h"

#include <gtest/gtest.h>

namespace dspm {
namespace pixel_statistics_test {

TEST(PixelStatistics, FollowsThePaper) {
  PixelStatistics s;
  s.N = 10, s.R2 = 4, s.tau = Rgb(6);
  s.absorb({5, Rgb(3)}, 0.7f);
  // N' = 10 + 0.7 * 5 = 13.5; (R'/R)^2 = 13.5 / 15 = 0.9; tau' = (6 + 3) * 0.9 = 8.1.
  EXPECT_NEAR(s.N, 13.5, 1e-6);
  EXPECT_NEAR(s.R2, 3.6, 1e-6);
  EXPECT_NEAR(s.tau.r, 8.1, 1e-6);
  // L = 8.1 / (1000 pi 3.6)
  EXPECT_NEAR(s.radiance(1000).g, 8.1 / (1000 * 3.14159265 * 3.6), 1e-8);
}

TEST(PixelStatistics, AnIterationWithoutPhotonsChangesNothing) {
  PixelStatistics s;
  s.R2 = 2, s.tau = Rgb(1), s.N = 3;
  s.absorb({0, Rgb()}, 0.7f);
  EXPECT_EQ(s.R2, 2);
  EXPECT_EQ(s.N, 3);
  EXPECT_EQ(s.tau, Rgb(1));
}

TEST(PixelStatistics, PhotonsWithoutEffectShrinkTheRadius) {
  PixelStatistics s;
  s.R2 = 1;
  s.absorb({100, Rgb()}, 0.7f);
  EXPECT_FLOAT_EQ(s.R2, 0.7f);
  EXPECT_EQ(s.radiance(1).r, 0);
}

// A uniform field of photons of density d and flux 1 gives radiance d / (emitted pi) * ... = d f at any radius: with M
// = d pi R^2 photons an iteration, tau / (Ne pi R^2) must stay d / photons, whatever the radius shrinks to.
TEST(PixelStatistics, AUniformFieldKeepsItsRadiance) {
  PixelStatistics s;
  s.R2 = 1;
  const double density = 1e6;
  double emitted = 0;
  for (int i = 0; i < 200; ++i) {
    const double M = std::round(density * 3.14159265358979 * static_cast<double>(s.R2));
    s.absorb({static_cast<std::uint32_t>(M), Rgb(static_cast<float>(M))}, 0.7f);
    emitted += 1;
    EXPECT_NEAR(s.radiance(emitted).r / density, 1, 1e-3);
  }
  EXPECT_LT(s.R2, 0.25f);
}

// The mean over all iterations, whatever the radius was when it was seen, also before there was one.
TEST(PixelStatistics, LightThatIsSeenKeepsItsRadiance) {
  constexpr float kEmitted = 1000;
  PixelStatistics s;
  s.see(Rgb(2), kEmitted);
  EXPECT_NEAR(s.radiance(double{kEmitted}).r, 2, 1e-6);
  s.begin(0.01f);
  s.absorb({50, Rgb()}, 0.7f);
  s.see(Rgb(4), kEmitted);
  s.begin(7);
  EXPECT_FLOAT_EQ(s.R2, 0.007f);
  s.absorb({50, Rgb()}, 0.7f);
  EXPECT_NEAR(s.radiance(2 * double{kEmitted}).r, 3, 1e-6);
}

TEST(PixelStatistics, CountsBeyond32Bits) {
  PixelStatistics s;
  s.R2 = 1, s.N = 1e12, s.tau = Rgb(1e12f);
  s.absorb({1000000, Rgb(1e6f)}, 0.7f);
  EXPECT_EQ(s.N, 1e12 + static_cast<double>(0.7f) * 1e6);
}

}  // namespace pixel_statistics_test
}  // namespace dspm
