#include "dspm/output/tone_map.h"

#include <gtest/gtest.h>

#include <limits>

#include "dspm/math/vec.h"

namespace dspm {
namespace {

TEST(ToneMap, ClippingTakesComponentsAlone) {
  EXPECT_EQ(shown(Rgb(0.25f, 1, 3), {}), Rgb(0.25f, 1, 1));
  EXPECT_EQ(shown(Rgb(0.25f, 1, 3), {0.5f, false}), Rgb(0.125f, 0.5f, 1));
  EXPECT_EQ(shown(Rgb(-1, 0, std::numeric_limits<float>::quiet_NaN()), {}), Rgb(0));
}

TEST(ToneMap, EverythingRisesAndStaysWithinOne) {
  for (const bool shoulder : {false, true}) {
    float last = -1;
    for (float radiance = 0; radiance < 100; radiance = radiance * 1.01f + 1e-4f) {
      const float value = shown(Rgb(radiance), {1, shoulder}).r;
      EXPECT_GE(value, last) << radiance;
      EXPECT_LE(value, 1.f);
      last = value;
    }
    EXPECT_EQ(shown(Rgb(kInfinity), {1, shoulder}), Rgb(1));
  }
}

TEST(ToneMap, TheShoulderKeepsTheHueAndDarkColours) {
  const ToneMap tone{1, true};
  EXPECT_EQ(shown(Rgb(0.8f, 0.1f, 0), tone), Rgb(0.8f, 0.1f, 0));
  const Rgb bright = shown(Rgb(4, 2, 1), tone);
  EXPECT_NEAR(bright.g / bright.r, 0.5f, 1e-6);
  EXPECT_NEAR(bright.b / bright.r, 0.25f, 1e-6);
  // Value and slope are continuous at the knee: 1 - 0.2 exp(-(m - 0.8) / 0.2) is 0.8 there, and rises with slope 1.
  EXPECT_NEAR(shown(Rgb(0.801f), tone).r, 0.801f, 5e-6);
}

}  // namespace
}  // namespace dspm
