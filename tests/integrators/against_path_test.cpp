// Every integrator against path tracing, tile by tile: what noise does not explain must be below a stated bias of the
// photons' blur.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "testing/agreement.h"
#include "testing/scenes.h"

namespace dspm::test {
namespace {

constexpr int kComparisons = 28;  // all of them together fail right integrators with a chance of 1%

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

class AgainstPath : public testing::TestWithParam<const char*> {
 protected:
  static Tiles render(const std::string& integrator, int iterations) {
    return rendered(box(fmt::format("Integrator {}\n", integrator), GetParam(), 24), iterations);
  }
  void expect_agreement(const std::string& integrator, int iterations, double bias) const {
    const Verdict verdict = agreement(render(integrator, iterations), path_, {0.01 / kComparisons, bias});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }

  const Tiles path_ = render(R"("path" "integer maxdepth" 16)", 56);
};

TEST_P(AgainstPath, AllIntegratorsAgree) {
  // Radius 0.05 of a box of 2: the blur leaks over edges, more where photons of a neighbouring wall lie within it.
  const std::string common = R"("integer maxdepth" 16 "integer photons" 30000 "float radius" 0.05 )";
  expect_agreement("\"sppm\" \"string estimator\" \"hj09\" " + common, 2, 0.04);
  expect_agreement("\"dsppm\" \"string estimator\" \"kz11\" " + common, 2, 0.04);
  expect_agreement("\"dsppm\" \"string estimator\" \"hj09\" \"string direct\" \"sampled\" " + common, 4, 0.04);
  expect_agreement(R"("photonmap" "integer maxdepth" 16 "integer photons" 100000 "float radius" 0.08)", 4, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Scenes, AgainstPath,
                         testing::Values(kDiffuse, kRoughMetal, kGlass, kCoat, kSmoothed, kRoughGlass,
                                         kGlossyMetalAndPoint));

}  // namespace
}  // namespace dspm::test
