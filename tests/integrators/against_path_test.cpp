// Every integrator against path tracing, tile by tile. Both are rendered with several seeds, which gives each tile's
// mean its standard error; what remains must be below kSigmas of the difference's error plus a stated bias of the
// photons' blur.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/render.h"
#include "tests/support/scenes.h"

namespace dspm {
namespace {

using testing::TestScene;

constexpr int kSize = 24, kTile = 6, kTiles = (kSize / kTile) * (kSize / kTile), kSeeds = 6;
// Student's t with 10 degrees of freedom at a level of 1% over 16 tiles x 28 comparisons (Bonferroni): t(0.01 / 448)
// = 7.0.
constexpr double kSigmas = 7.0;

struct TileMeans {
  std::vector<double> mean, variance;  // of the mean
};

TileMeans render(const std::string& contents, const std::string& integrator, int iterations) {
  std::vector<double> sum(kTiles, 0), sum2(kTiles, 0);
  for (int seed = 0; seed < kSeeds; ++seed) {
    TestScene test(testing::box(fmt::format("Integrator {} \"integer seed\" {}\n", integrator, seed), contents, kSize));
    const Image image = test.render(0, iterations);
    std::vector<double> tile(kTiles, 0);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        tile[static_cast<std::size_t>(y / kTile * (kSize / kTile) + x / kTile)] +=
            static_cast<double>(luminance(image.at(x, y))) / (kTile * kTile);
    for (std::size_t t = 0; t < tile.size(); ++t) sum[t] += tile[t], sum2[t] += tile[t] * tile[t];
  }
  TileMeans result;
  for (std::size_t t = 0; t < sum.size(); ++t) {
    const double mean = sum[t] / kSeeds;
    result.mean.push_back(mean);
    result.variance.push_back(std::max(0.0, sum2[t] / kSeeds - mean * mean) / (kSeeds - 1));
  }
  return result;
}

void expect_agreement(const TileMeans& a, const TileMeans& b, double bias) {
  double sum_a = 0, sum_b = 0;
  for (std::size_t t = 0; t < a.mean.size(); ++t) {
    const double error = std::sqrt(a.variance[t] + b.variance[t]);
    EXPECT_LE(std::abs(a.mean[t] - b.mean[t]), kSigmas * error + bias * b.mean[t])
        << "tile " << t << ": " << a.mean[t] << " against " << b.mean[t] << ", error " << error;
    sum_a += a.mean[t], sum_b += b.mean[t];
  }
  EXPECT_NEAR(sum_a / sum_b, 1, 0.02 + bias / 2);
}

constexpr const char* kDiffuse = R"(
Material "diffuse" "rgb reflectance" [.5 .5 .8]
Translate 0 -0.6 0.2
Shape "sphere" "float radius" 0.4)";
constexpr const char* kRoughMetal = R"(
Material "conductor" "float roughness" 0.35
Translate 0 -0.4 0.2
Shape "sphere" "float radius" 0.5)";
constexpr const char* kGlass = R"(
Material "dielectric" "float eta" 1.5
Translate 0 -0.4 0.2
Shape "sphere" "float radius" 0.45)";
constexpr const char* kCoat = R"(
Material "coateddiffuse" "rgb reflectance" [.6 .4 .2] "float roughness" 0.3
Translate 0 -0.4 0.2
Shape "sphere" "float radius" 0.5)";
// Interpolated normals: the shading normal differs from the geometric one everywhere.
constexpr const char* kSmoothed = R"(
Material "diffuse" "rgb reflectance" [.8 .8 .8]
Translate 0 -0.5 0.2
Shape "loopsubdiv" "integer levels" 1 "integer indices" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]
  "point3 P" [.7 0 0 -.7 0 0 0 .7 0 0 -.7 0 0 0 .7 0 0 -.7])";

// Both of its lobes gather: light that comes through the surface counts as well.
constexpr const char* kRoughGlass = R"(
Material "dielectric" "float eta" 1.5 "float roughness" 0.15
Translate 0 -0.4 0.2
Shape "sphere" "float radius" 0.5)";
// Smoother than what gathers: its lobe is followed, and no ray finds the point light.
constexpr const char* kGlossyMetalAndPoint = R"(
LightSource "point" "rgb I" [2 2 2] "point3 from" [0.3 0.5 -0.9]
Material "conductor" "float roughness" 0.03
Translate 0 -0.4 0.2
Shape "sphere" "float radius" 0.5)";

class AgainstPath : public ::testing::TestWithParam<const char*> {};

TEST_P(AgainstPath, AllIntegratorsAgree) {
  const TileMeans path = render(GetParam(), R"("path" "integer maxdepth" 16)", 150);
  // Radius 0.05 of a box of 2: the blur leaks over edges, more where photons of a neighbouring wall lie within it.
  const std::string common = R"("integer maxdepth" 16 "integer photons" 30000 "float radius" 0.05 )";
  expect_agreement(render(GetParam(), "\"sppm\" \"string estimator\" \"hj09\" " + common, 6), path, 0.04);
  expect_agreement(render(GetParam(), "\"dsppm\" \"string estimator\" \"kz11\" " + common, 6), path, 0.04);
  expect_agreement(
      render(GetParam(), "\"dsppm\" \"string estimator\" \"hj09\" \"string direct\" \"sampled\" " + common, 12), path,
      0.04);
  expect_agreement(
      render(GetParam(), R"("photonmap" "integer maxdepth" 16 "integer photons" 100000 "float radius" 0.08)", 12), path,
      0.06);
}

INSTANTIATE_TEST_SUITE_P(Scenes, AgainstPath,
                         ::testing::Values(kDiffuse, kRoughMetal, kGlass, kCoat, kSmoothed, kRoughGlass,
                                           kGlossyMetalAndPoint));

}  // namespace
}  // namespace dspm
