// What frames that differ in looks or light only share, by count of work.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/render.h"

namespace dspm {
namespace {

using testing::TestScene;

constexpr int kFrames = 6;

/// A box with a ball of a material, and a lamp, after one iteration of all frames.
Statistics work(const std::string& material, const std::string& lamp, const char* mixture) {
  TestScene test(fmt::format(
      R"(Frames {}
Integrator "dsppm" "integer photons" 2000 "bool mixture" {}
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 24 "integer yresolution" 24
WorldBegin
LightSource "point" {} "point3 from" [0.3 0.9 -0.6]
Material "diffuse" "rgb reflectance" [.7 .6 .5]
ReverseOrientation
Shape "sphere" "float radius" 4.5
ReverseOrientation
Material {}
Shape "sphere" "float radius" 0.8)",
      kFrames, mixture, lamp, material));
  const auto scene = test.scene(test.all_frames());
  const auto integrator = test.integrator(*scene);
  integrator->iterate(0);
  return integrator->statistics();
}

constexpr const char* kSteady = R"("rgb I" [5 5 5])";

TEST(JointPaths, ColoursShareEverything) {
  for (const char* material : {R"("diffuse" "rgb reflectance@1" [.8 .1 .1] "rgb reflectance@6" [.1 .1 .8])",
                               R"("coateddiffuse" "rgb reflectance@1" [.8 .1 .1] "rgb reflectance@6" [.1 .1 .8])"}) {
    const Statistics joint = work(material, kSteady, "true"), apart = work(material, kSteady, "false");
    EXPECT_EQ(joint.camera.segments.factor(), kFrames) << material;
    EXPECT_EQ(joint.camera.segments.separate, apart.camera.segments.separate);
    EXPECT_EQ(joint.photon.segments.separate, apart.photon.segments.separate);
    // Roulette leaves some photon paths to some frames.
    EXPECT_GT(joint.photon.segments.factor(), 0.8 * kFrames);
    EXPECT_LT(apart.photon.segments.factor(), 0.75 * kFrames);
    EXPECT_LT(joint.photon_tests.done, apart.photon_tests.done);
    EXPECT_GT(joint.camera.weighted, 0u);
    EXPECT_GT(joint.photon.weighted, 0u);
    EXPECT_EQ(apart.camera.weighted + apart.photon.weighted, 0u);
  }
}

TEST(JointPaths, ADimmingLampSharesEverything) {
  const char* grey = R"("diffuse" "rgb reflectance" [.5 .5 .5])";
  const Statistics dims = work(grey, R"("rgb I" [5 4 3] "float scale@1" 10 "float scale@6" 2)", "true");
  const Statistics burns = work(grey, kSteady, "true");
  EXPECT_EQ(dims.photon.segments.done, burns.photon.segments.done);
  EXPECT_EQ(dims.photons_stored.done, burns.photons_stored.done);
  EXPECT_EQ(dims.photons_found.done, burns.photons_found.done);
  EXPECT_EQ(dims.photon.segments.factor(), kFrames);
}

TEST(JointPaths, OtherDirectionsPart) {
  const Statistics glass = work(R"("dielectric" "float eta@1" 1.3 "float eta@6" 1.7)", kSteady, "true");
  EXPECT_LT(glass.camera.segments.factor(), kFrames);
}

}  // namespace
}  // namespace dspm
