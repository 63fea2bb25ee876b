// A closed, evenly glowing, evenly reflecting sphere has radiance 1 / (1 - albedo) everywhere: see furnace() for why.
#include <gtest/gtest.h>

#include "tests/support/render.h"
#include "tests/support/scenes.h"

namespace dspm {
namespace {

using testing::TestScene;

struct Case {
  const char* integrator;
  int iterations;
  double tolerance;  // of the image's mean: four standard errors, measured over 20 seeds, and the blur's bias
};

class Furnace : public ::testing::TestWithParam<Case> {};

TEST_P(Furnace, HasTheAnalyticRadiance) {
  for (const float albedo : {0.f, 0.5f, 0.8f}) {
    TestScene test(testing::furnace(GetParam().integrator, albedo));
    const Image image = test.render(0, GetParam().iterations);
    double sum = 0;
    for (const Rgb& pixel : image.pixels) sum += static_cast<double>(pixel.g);
    const double mean = sum / static_cast<double>(image.pixels.size());
    EXPECT_NEAR(mean * (1 - static_cast<double>(albedo)), 1, GetParam().tolerance)
        << GetParam().integrator << " albedo " << albedo;
  }
}

// maxdepth 40: what is left out is 0.8^40 = 0.013%.
INSTANTIATE_TEST_SUITE_P(
    Integrators, Furnace,
    ::testing::Values(
        Case{R"("path" "integer maxdepth" 40)", 60, 0.01},
        Case{R"("sppm" "integer maxdepth" 40 "integer photons" 40000 "string estimator" "hj09")", 6, 0.01},
        Case{R"("sppm" "integer maxdepth" 40 "integer photons" 40000)", 6, 0.01},
        Case{R"("dsppm" "integer maxdepth" 40 "integer photons" 40000 "string estimator" "hj09")", 6, 0.01},
        Case{R"("dsppm" "integer maxdepth" 40 "integer photons" 40000 "string estimator" "kz11")", 6, 0.01},
        Case{R"("dsppm" "integer maxdepth" 40 "integer photons" 40000 "string direct" "sampled")", 20, 0.02},
        Case{R"("photonmap" "integer maxdepth" 40 "integer photons" 200000 "float radius" 0.2)", 20, 0.02}));

}  // namespace
}  // namespace dspm
