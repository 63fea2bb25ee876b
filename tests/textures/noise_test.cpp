// Noise against Perlin's published value and values worked out by hand from his permutation, and what follows from its
// definition: zeros, range, smoothness.
#include "dspm/textures/noise.h"

#include <cmath>
#include <limits>
#include <random>

#include "tests/textures/make.h"

namespace dspm {
namespace noise_test {

/// Points spread over the lattice, also where it repeats.
template <class Fn>
void for_each_point(int count, Fn&& fn) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-300, 300);
  for (int i = 0; i < count; ++i) fn(Vec3{coordinate(random), coordinate(random), coordinate(random)});
}

TEST(Noise, IsZeroOnTheLattice) {
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = 254; z <= 258; ++z)
        EXPECT_EQ(noise({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}), 0);
}

// The value of Perlin's reference implementation at that point is widely published (Rosetta Code, "Perlin noise"). The
// hash of the corners of the first cell ends in 4, 7, 12, 14, 6, 4, 0 and 3 for (x, y, z) = 000, 001, 010, 011, 100,
// 101, 110 and 111. At its middle every weight is 1/8, every offset 1/2 or -1/2, and the gradients of pbrt's table
// contribute x + z = 1, -x - z = 0, x + y = 0, y - z = 0, x - z = -1, x + z = -1, x + y = -1 and -x - y = 1 of 1/2 each.
TEST(Noise, KnownValues) {
  EXPECT_NEAR(noise({3.14f, 42, 7}), 0.13691995878f, 2e-6f);
  EXPECT_NEAR(noise({0.5f, 0.5f, 0.5f}), -0.125f, 1e-7f);
  // By an independent program in double.
  EXPECT_NEAR(noise({0.25f, 0.75f, 1.5f}), 0.07316350937f, 1e-6f);
  EXPECT_NEAR(noise({-1.3f, 2.7f, 100.1f}), 0.2280351730f, 1e-5f);
  EXPECT_NEAR(noise({10.5f, 0.25f, -3.75f}), 0.1451449394f, 1e-6f);
}

TEST(Noise, RepeatsAfter256AndStaysWithinOne) {
  for_each_point(20000, [](const Vec3& p) {
    const Vec3 whole{std::floor(p.x), std::floor(p.y), std::floor(p.z)}, part{0.25f, 0.5f, 0.375f};
    EXPECT_EQ(noise(whole + part), noise(whole + part + Vec3{256, -512, 256}));
    EXPECT_LE(std::abs(noise(p)), 1);
  });
}

TEST(Noise, HasNoMeanAndAMeanSizeOfAFifth) {
  double sum = 0, sizes = 0;
  constexpr int kCount = 40000;
  for_each_point(kCount, [&](const Vec3& p) { sum += noise(p), sizes += std::abs(noise(p)); });
  EXPECT_NEAR(sum / kCount, 0, 0.01);
  EXPECT_NEAR(sizes / kCount, 0.2, 0.03);
}

// Its gradient is at most about 3 in length; across cells it is continuous, so both sides of a face agree.
TEST(Noise, IsContinuousWithAContinuousGradient) {
  constexpr float kStep = 1.f / 128;
  const auto slope = [](const Vec3& p, const Vec3& to) { return (noise(p + to * kStep) - noise(p)) / kStep; };
  for_each_point(5000, [&](const Vec3& p) {
    const Vec3 face{std::floor(p.x), p.y, p.z};
    EXPECT_NEAR(noise(face + Vec3{1e-4f, 0, 0}), noise(face - Vec3{1e-4f, 0, 0}), 1e-3f);
    EXPECT_NEAR(slope(face, {1, 0, 0}), -slope(face, {-1, 0, 0}), 0.05f);
    for (const Vec3& to : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) EXPECT_LE(std::abs(slope(p, to)), 3);
  });
}

TEST(Noise, OddCoordinatesHaveAnAnswer) {
  for (const float odd : {kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()})
    EXPECT_EQ(noise({odd, 1, 2}), 0);
  for (const float large : {3e38f, -3e38f, 1e9f, -1e-30f}) EXPECT_TRUE(std::isfinite(noise({large, 0.5f, large})));
}

TEST(Octaves, AddUp) {
  const Vec3 p{0.3f, -1.7f, 9.1f};
  const float one = noise(p), two = noise(p * 1.99f), three = noise(p * (1.99f * 1.99f));
  EXPECT_EQ(fbm(p, {0, 0.5f}), 0);
  EXPECT_FLOAT_EQ(fbm(p, {1, 0.5f}), one);
  EXPECT_NEAR(fbm(p, {3, 0.25f}), one + two / 4 + three / 16, 1e-6f);
  EXPECT_NEAR(turbulence(p, {3, 0.25f}), std::abs(one) + std::abs(two) / 4 + std::abs(three) / 16, 1e-6f);
}

}  // namespace noise_test
}  // namespace dspm
