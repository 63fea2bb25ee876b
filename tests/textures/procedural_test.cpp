// Textures that are computed: each against its formula, written down here a second time.
#include <cmath>
#include <random>

#include "dspm/textures/noise.h"
#include "tests/textures/make.h"

namespace dspm {
namespace procedural_test {

/// Twice as large, turned by a right angle (x becomes y), and away from the origin.
Transform placement() {
  return Transform(Matrix4::translate(5, 0, 0) * Matrix4::rotate(90, 0, 0, 1) * Matrix4::scale(2, 2, 2));
}
const Vec3 kOwn{0.3f, -0.7f, 1.2f};                         // in the texture's space
const Vec3 kWorld{5 - 2 * kOwn.y, 2 * kOwn.x, 2 * kOwn.z};  // the same point
TexturePoint at_world() { return {kWorld, {}}; }

constexpr float kTightByHash = 2e-5f;

TEST(Fbm, IsASumOfOctavesInItsOwnSpace) {
  Workshop w;
  const auto t = w.make<float>("fbm", {integer_param("octaves", 2), number_param("roughness", .25f)}, placement());
  EXPECT_NEAR(t->evaluate(at_world()), noise(kOwn) + .25f * noise(kOwn * 1.99f), kTightByHash);
  const auto usual = w.make<Rgb>("fbm", {}, placement());
  float sum = 0;
  for (int i = 0; i < 8; ++i)
    sum += std::pow(.5f, static_cast<float>(i)) * noise(kOwn * std::pow(1.99f, static_cast<float>(i)));
  EXPECT_NEAR(usual->evaluate(at_world()).g, sum, 1e-4f);
  EXPECT_EQ(w.message(), "");
  for (const int wrong : {-1, 65}) w.make<float>("fbm", {integer_param("octaves", wrong)});
  EXPECT_EQ(w.diagnostics.error_count(), 2);
}

TEST(Wrinkled, IsASumOfFoldedOctaves) {
  Workshop w;
  const auto t = w.make<float>("wrinkled", {integer_param("octaves", 2), number_param("roughness", .25f)}, placement());
  EXPECT_NEAR(t->evaluate(at_world()), std::abs(noise(kOwn)) + .25f * std::abs(noise(kOwn * 1.99f)), kTightByHash);
}

TEST(Windy, IsWavesTimesGusts) {
  Workshop w;
  const auto sum = [](const Vec3& p, int octaves) {
    float s = 0;
    for (int i = 0; i < octaves; ++i)
      s += std::pow(.5f, static_cast<float>(i)) * noise(p * std::pow(1.99f, static_cast<float>(i)));
    return s;
  };
  EXPECT_NEAR(w.make<float>("windy", {}, placement())->evaluate(at_world()),
              std::abs(sum(kOwn * .1f, 3)) * sum(kOwn, 6), kTightByHash);
}

// At t = 0 of a curve its value is the first control point, at t = 1 the fourth.
TEST(Marble, RunsAlongItsSpline) {
  Workshop w;
  const auto t = w.make<Rgb>("marble", {number_param("variation", 0), number_param("scale", 2)});
  const auto at = [&](double along) {  // the whole spline from 0 to 1
    return t->evaluate(at_point(7, static_cast<float>(std::asin(2 * along - 1) / 2), 3));
  };
  const auto expect = [](const Rgb& a, const Rgb& b) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], 1.5f * b[c], 1e-4f);
  };
  const Rgb pale(.58f, .58f, .6f), grey(.5f), warm(.6f, .59f, .58f), vein(.2f, .2f, .33f);
  expect(at(0), pale);
  expect(at(1), pale);
  expect(at(.5 + 1e-9), grey);                                   // the fourth curve begins
  expect(at(.5 - 1e-6), pale);                                   // the third ends
  expect(at(5.5 / 6), (pale + 3 * pale + 3 * vein + pale) / 8);  // the middle of the last
  expect(at(1.5 / 6), (pale + 3 * pale + 3 * grey + warm) / 8);  // of the second
  const auto number = w.make<float>("marble", {number_param("variation", 0), number_param("scale", 2)});
  EXPECT_NEAR(number->evaluate(at_point(0, static_cast<float>(std::asin(1.) / 2), 0)), 1.5f * 1.76f / 3, 1e-4f);
}

TEST(Marble, VariationMovesTheLayers) {
  Workshop w;
  const auto still = w.make<Rgb>("marble", {number_param("variation", 0)}, placement());
  const auto moved = w.make<Rgb>("marble", {number_param("variation", 2), integer_param("octaves", 1)}, placement());
  TexturePoint there = at_world();
  there.p.x -= 2 * 2 * noise(kOwn);  // y in the texture's space is -x in the world, at twice the size
  EXPECT_NEAR(moved->evaluate(at_world()).b, still->evaluate(there).b, 1e-4f);
  for (const float odd : {kInfinity, 3e38f}) EXPECT_TRUE(is_finite(moved->evaluate(at_point(odd, odd, 1))));
}

TEST(Bilerp, HoldsItsCornersAndIsLinearBetween) {
  Workshop w;
  const auto t = w.make<float>("bilerp", {number_param("v00", 1), number_param("v01", 2), number_param("v10", 3),
                                          number_param("v11", 8), number_param("uscale", 2)});
  EXPECT_EQ(t->evaluate(at_uv(0, 0)), 1);
  EXPECT_EQ(t->evaluate(at_uv(0, 1)), 2);
  EXPECT_EQ(t->evaluate(at_uv(.5f, 0)), 3);
  EXPECT_EQ(t->evaluate(at_uv(.5f, 1)), 8);
  EXPECT_EQ(t->evaluate(at_uv(.25f, .5f)), 3.5f);
  EXPECT_EQ(t->evaluate(at_uv(1, 0)), 5);  // the slope goes on
  const auto usual = w.make<Rgb>("bilerp", {triple_param(ParamType::rgb, "v11", .5f, .25f, 0)});
  EXPECT_EQ(usual->evaluate(at_uv(0, .5f)), Rgb(.5f));
  EXPECT_EQ(usual->evaluate(at_uv(1, .5f)), Rgb(.25f, .125f, 0));
  EXPECT_FALSE(usual->constant());
  EXPECT_EQ(w.make<float>("bilerp", {number_param("v01", 0), number_param("v11", 0)})->constant(), 0);
}

TEST(DirectionMix, GoesByTheCosineToItsDirection) {
  Workshop w;
  const auto t = w.make<float>(
      "directionmix",
      {number_param("tex1", 2), number_param("tex2", 10), triple_param(ParamType::vector3, "dir", 3, 0, 0)},
      placement());  // +y in the world
  const auto facing = [&](Vec3 n) { return t->evaluate({{}, {}, n}); };
  EXPECT_NEAR(facing({0, 1, 0}), 2, kTightByHash);
  EXPECT_NEAR(facing({0, -1, 0}), 2, kTightByHash);
  EXPECT_NEAR(facing({1, 0, 0}), 10, kTightByHash);
  EXPECT_NEAR(facing({.8f, .6f, 0}), .6f * 2 + .4f * 10, kTightByHash);
  EXPECT_EQ(w.make<Rgb>("directionmix", {})->evaluate({{}, {}, {0, 0, 1}}), Rgb(1));
  EXPECT_EQ(w.make<Rgb>("directionmix", {})->evaluate({{}, {}, {0, 1, 0}}), Rgb(0));
  EXPECT_EQ(w.message(), "");
  w.make<float>("directionmix", {triple_param(ParamType::vector3, "dir", 0, 0, 0)});
  EXPECT_EQ(w.message(), "\"dir\" has no direction");
}

// The noise says where the dots are. In each square around a point with whole coordinates, all of a dot's disk and
// nothing else belongs to it; as in pbrt's pictures it has what "outside" says.
TEST(Dots, LieWhereNoiseSays) {
  Workshop w;
  const auto t = w.make<float>("dots", {number_param("inside", 5), number_param("outside", 3)});
  std::mt19937 random(3);
  std::uniform_real_distribution<float> within(-.5f, .5f);
  int dots = 0;
  for (int x = -10; x < 10; ++x)
    for (int y = -10; y < 10; ++y) {
      const float s = static_cast<float>(x), v = static_cast<float>(y);
      const bool dot = noise({s + .5f, v + .5f, .5f}) > 0;
      const float cx = s + .15f * noise({s + 1.5f, v + 2.8f, .5f}), cy = v + .15f * noise({s + 4.5f, v + 9.8f, .5f});
      dots += dot;
      for (int i = 0; i < 20; ++i) {
        const float px = s + within(random), py = v + within(random), away = std::hypot(px - cx, py - cy);
        if (std::abs(away - .35f) < 1e-4f) continue;
        EXPECT_EQ(t->evaluate(at_uv(px, py)), dot && away < .35f ? 3 : 5);
      }
    }
  EXPECT_GT(dots, 100);
  EXPECT_LT(dots, 300);
  EXPECT_EQ(w.make<Rgb>("dots", {})->evaluate(at_uv(kInfinity, 0)), Rgb(1));
}

}  // namespace procedural_test
}  // namespace dspm
