// Points of a segment near a light.
#include "dspm/integrators/photons/near_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dspm/base/math/sampling.h"

namespace dspm {
namespace near_light_test {

struct Drawn {
  std::mt19937 random{3};
  float number(float low = 0, float high = 1) { return std::uniform_real_distribution<float>(low, high)(random); }
  Vec3 point() { return {number(-2, 2), number(-2, 2), number(-2, 2)}; }
  Vec3 direction() { return uniform_sphere({number(), number()}); }
};

bool lights(const LightBounds& spot, const Vec3& p) {
  return dot(normalize(p - spot.box.center()), spot.axis) >= std::cos(spot.spread + spot.reach);
}

// The density is that of a distribution, and none where a spot does not shine.
TEST(NearLight, HasADensityWhereItsLightGoes) {
  constexpr int kSteps = 20'000;
  Drawn drawn;
  int empty = 0;
  for (int i = 0; i < 300; ++i) {
    const Ray ray{drawn.point(), drawn.direction()};
    const Vec3 p = drawn.point();
    LightBounds light{{p, p}};
    const bool is_spot = i % 3 != 0;
    if (is_spot)
      light.axis = drawn.direction(), light.spread = drawn.number(0, 0.5f), light.reach = drawn.number(0.02f, 1);
    if (i % 3 == 2) light.box.high = light.box.high + Vec3{0.3f, 0.1f, 0.2f};
    const float begin = drawn.number(0, 1), end = begin + drawn.number(0.1f, 3);
    const NearLight near(ray, begin, end, light);
    const bool is_cone = i % 3 == 1;
    double sum = 0;
    int lit = 0;
    for (int s = 0; s < kSteps; ++s) {
      const float t = begin + (end - begin) * (static_cast<float>(s) + 0.5f) / kSteps;
      const float density = near.density(t);
      sum += static_cast<double>(density * (end - begin)) / kSteps;
      if (!is_cone) continue;
      lit += lights(light, ray.at(t));
      // Not at the cone's rim, which may lie on either side.
      const bool is_lit = lights(light, ray.at(t));
      const bool is_rim = lights(light, ray.at(t - 1e-3f)) != lights(light, ray.at(t + 1e-3f));
      EXPECT_TRUE(is_rim || (density > 0) == is_lit) << i << " " << t;
    }
    if (near.is_empty()) {
      EXPECT_EQ(sum, 0);
      EXPECT_LT(lit, kSteps / 1000);
      ++empty;
      continue;
    }
    EXPECT_NEAR(sum, 1, is_cone && lit < 200 ? 0.3 : 0.01) << i;
  }
  EXPECT_GT(empty, 20);
  EXPECT_LT(empty, 100);
}

// A point is drawn as often as its density says.
TEST(NearLight, DrawsByItsDensity) {
  const NearLight near({{0, 0, -3}, {0, 0, 1}}, 1, 6, {{{0.5f, 0.2f, 0}, {0.5f, 0.2f, 0}}});
  constexpr int kDraws = 10'000;
  double inverse = 0, square = 0;
  for (int i = 0; i < kDraws; ++i) {
    const float t = near.draw((static_cast<float>(i) + 0.5f) / kDraws), density = near.density(t);
    ASSERT_TRUE(t >= 1 && t <= 6 && density > 0);
    inverse += static_cast<double>(1 / density) / kDraws;
    square += static_cast<double>(t * t / density) / kDraws;
  }
  EXPECT_NEAR(inverse, 5, 1e-3);
  EXPECT_NEAR(square, (216. - 1) / 3, 0.05);
}

}  // namespace near_light_test
}  // namespace dspm
