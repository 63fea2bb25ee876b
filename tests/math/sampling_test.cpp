// Every warp is checked in two ways: what it yields lies where it should, and the mean of known functions under uniform
// numbers equals their integral against the density. The numbers are a lattice, so a pass is a pass; on n = 10^6 points
// its error for these smooth functions is far below the tolerance of 2e-3.
#include "dspm/base/math/sampling.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "dspm/base/math/distribution.h"

namespace dspm {
namespace {

constexpr int kSide = 1000;

/// The mean of value(u) over the centres of a kSide x kSide grid.
template <class Value>
double mean(Value&& value) {
  double sum = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      sum += static_cast<double>(
          value(Vec2{(static_cast<float>(x) + .5f) / kSide, (static_cast<float>(y) + .5f) / kSide}));
  return sum / (kSide * kSide);
}

constexpr Vec2 kCorners[] = {{0, 0}, {0, 0.99999994f}, {0.99999994f, 0}, {0.99999994f, 0.99999994f}, {.5f, .5f}};

TEST(Sampling, ConcentricDiskIsUniform) {
  for (const Vec2 u : kCorners) {
    const Vec2 d = concentric_disk(u);
    EXPECT_LE(d.x * d.x + d.y * d.y, 1.000001f);
  }
  EXPECT_NEAR(mean([](Vec2 u) { return concentric_disk(u).x; }), 0, 2e-3);
  EXPECT_NEAR(mean([](Vec2 u) {
                const Vec2 d = concentric_disk(u);
                return d.x * d.x + d.y * d.y;
              }),
              0.5, 2e-3);
  EXPECT_NEAR(mean([](Vec2 u) {
                const Vec2 d = concentric_disk(u);
                return d.x * d.x + d.y * d.y < .25f;
              }),
              .25, 2e-3);
  EXPECT_NEAR(mean([](Vec2 u) {
                const Vec2 d = concentric_disk(u);
                return d.y > std::abs(d.x);
              }),
              .25, 2e-3);
}

// Under a density p, the mean of f is the integral of f p: for p = cos / pi and f = cos^n it is 2 / (n + 2).
TEST(Sampling, CosineHemisphereFollowsTheCosine) {
  for (const Vec2 u : kCorners) EXPECT_NEAR(length(cosine_hemisphere(u)), 1, 1e-6f);
  EXPECT_NEAR(mean([](Vec2 u) { return cosine_hemisphere(u).z; }), 2. / 3, 2e-3);
  EXPECT_NEAR(mean([](Vec2 u) {
                const float z = cosine_hemisphere(u).z;
                return z * z;
              }),
              0.5, 2e-3);
  // The mean of 1 / p is the measure of the hemisphere; above 1 degree from the horizon, where 1 / p is bounded.
  const float horizon = 0.0174524f;
  EXPECT_NEAR(mean([&](Vec2 u) {
                const float z = cosine_hemisphere(u).z;
                return z > horizon ? 1 / cosine_hemisphere_pdf_w(z) : 0;
              }),
              2 * kPi * (1 - horizon), 0.02);
  EXPECT_EQ(cosine_hemisphere_pdf_w(-.5f), 0);
}

TEST(Sampling, SphereAndHemisphereAreUniform) {
  for (const Vec2 u : kCorners) {
    EXPECT_NEAR(length(uniform_sphere(u)), 1, 1e-6f);
    EXPECT_NEAR(length(uniform_hemisphere(u)), 1, 1e-6f);
    EXPECT_GE(uniform_hemisphere(u).z, 0);
  }
  EXPECT_NEAR(mean([](Vec2 u) { return uniform_sphere(u).z; }), 0, 2e-3);
  EXPECT_NEAR(mean([](Vec2 u) {
                const float x = uniform_sphere(u).x;
                return x * x;
              }),
              1. / 3, 2e-3);
  EXPECT_NEAR(mean([](Vec2 u) {
                const float y = uniform_sphere(u).y;
                return y * y;
              }),
              1. / 3, 2e-3);
  EXPECT_NEAR(mean([](Vec2 u) { return uniform_hemisphere(u).z; }), 0.5, 2e-3);
  EXPECT_NEAR(kUniformSpherePdfW * 4 * kPi, 1, 1e-6f);
  EXPECT_NEAR(kUniformHemispherePdfW * 2 * kPi, 1, 1e-6f);
}

TEST(Sampling, ConesAreUniformHoweverNarrow) {
  for (const float h : {1.f, .1f, 1e-4f, 1e-9f}) {
    for (const Vec2 u : kCorners) EXPECT_NEAR(length(uniform_cone(u, h)), 1, 1e-6f);
    // sin^2 = 1 - cos^2 with 1 - cos uniform in [0, h): its mean is h - h^2 / 3.
    const double mean_sin2 = mean([&](Vec2 u) {
      const Vec3 w = uniform_cone(u, h);
      return w.x * w.x + w.y * w.y;
    });
    const double expected = static_cast<double>(h) - static_cast<double>(h) * static_cast<double>(h) / 3;
    EXPECT_NEAR(mean_sin2 / expected, 1, 2e-3) << h;
  }
  EXPECT_NEAR(uniform_cone_pdf_w(2) * 4 * kPi, 1, 1e-6f);  // the whole sphere
}

TEST(Sampling, TriangleIsUniform) {
  for (const Vec2 u : kCorners) {
    const Vec2 b = uniform_triangle(u);
    EXPECT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1.000001f);
  }
  EXPECT_NEAR(mean([](Vec2 u) { return uniform_triangle(u).x; }), 1. / 3, 2e-3);
  EXPECT_NEAR(mean([](Vec2 u) {
                const Vec2 b = uniform_triangle(u);
                return 1 - b.x - b.y;
              }),
              1. / 3, 2e-3);
  EXPECT_NEAR(mean([](Vec2 u) {
                const float x = uniform_triangle(u).x;
                return x * x;
              }),
              1. / 6, 2e-3);
  EXPECT_NEAR(mean([](Vec2 u) {
                const Vec2 b = uniform_triangle(u);
                return b.x * b.y;
              }),
              1. / 12, 2e-3);
}

TEST(Distribution1D, ChoosesInProportion) {
  const std::vector<float> weights{0, 1, 0, 3, 4, 0};
  const Distribution1D distribution(weights);
  EXPECT_EQ(distribution.total(), 8);
  std::vector<int> counts(weights.size());
  double rest = 0;
  for (int i = 0; i < 8000; ++i) {
    const Distribution1D::Choice choice = distribution.choose((static_cast<float>(i) + .5f) / 8000);
    ++counts[static_cast<std::size_t>(choice.index)];
    EXPECT_EQ(choice.probability, distribution.probability(choice.index));
    EXPECT_TRUE(choice.rest >= 0 && choice.rest < 1);
    rest += static_cast<double>(choice.rest);
  }
  EXPECT_EQ(counts, (std::vector<int>{0, 1000, 0, 3000, 4000, 0}));
  EXPECT_NEAR(rest / 8000, 0.5, 1e-3);
}

/// Whatever the shape of the weights: the last bin that begins at or below u, found one by one.
TEST(Distribution1D, ChoosesAsASearchFromTheStartWould) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int i = 0; i < 200; ++i) {
    std::vector<float> weights(1 + random() % 300);
    for (float& weight : weights)
      weight = i % 3 == 0 ? uniform(random) : uniform(random) < 0.9f ? 0 : std::pow(uniform(random), 8.f);
    if (i % 5 == 0) weights[random() % weights.size()] = 1e4f;  // a sun
    const Distribution1D distribution(weights);
    for (int k = 0; k < 100; ++k) {
      const float u = k == 0 ? 0 : k == 1 ? 0x1.fffffep-1f : uniform(random);
      const int chosen = distribution.choose(u).index;
      int expected = 0;
      while (expected + 1 < distribution.size() && distribution.number(expected + 1, 0) <= u) ++expected;
      EXPECT_EQ(chosen, expected) << u;
    }
  }
}

TEST(Distribution1D, NeverChoosesWhatHasNoWeight) {
  std::vector<float> weights(1000, 0.f);
  for (std::size_t i = 1; i < 990; i += 7) weights[i] = 0.1f + static_cast<float>(i % 5);
  const Distribution1D distribution(weights);
  float sum = 0;
  for (int i = 0; i < distribution.size(); ++i) sum += distribution.probability(i);
  EXPECT_NEAR(sum, 1, 1e-5f);
  for (const float u : {0.f, 1e-30f, .25f, .5f, 0.99999988f, 0.99999994f, 1.f}) {
    const Distribution1D::Choice choice = distribution.choose(u);
    EXPECT_GT(weights[static_cast<std::size_t>(choice.index)], 0) << u;
    EXPECT_GT(choice.probability, 0);
  }
}

TEST(Distribution1D, WithoutAnyWeightAllAreAlike) {
  const Distribution1D distribution(std::vector<float>(4, 0.f));
  EXPECT_EQ(distribution.total(), 0);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(distribution.probability(i), .25f);
  EXPECT_EQ(distribution.choose(.6f).index, 2);
}

}  // namespace
}  // namespace dspm
