// What frames that differ in looks or light only share, by count of work.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace joint_paths_test {

using test::TestScene;

constexpr int kFrames = 6;

/// A ball of a material in a room, and a lamp.
std::string scene(const std::string& material, const std::string& lamp, const char* share_paths, int photons = 2000) {
  return fmt::format(
      R"(Frames {}
Integrator "dsppm" "integer photons" {} "bool sharepaths" {} "string indirect" "photons"
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 24 "integer yresolution" 24
WorldBegin
LightSource {} "point3 from" [0.3 0.9 -2.6]
Material "diffuse" "rgb reflectance" [.7 .6 .5]
ReverseOrientation
Shape "sphere" "float radius" 4.5
ReverseOrientation
Material {}
Shape "sphere" "float radius" 0.8)",
      kFrames, photons, share_paths, lamp, material);
}

/// Of one iteration of all frames.
Statistics work(const std::string& material, const std::string& lamp, const char* share_paths) {
  TestScene test(scene(material, lamp, share_paths));
  const auto all = test.scene(test.all_frames());
  const auto integrator = test.integrator(*all);
  integrator->iterate({0, *all});
  return integrator->statistics();
}

constexpr const char* kSteady = R"("point" "rgb I" [5 5 5])";
constexpr const char* kGrey = R"("diffuse" "rgb reflectance" [.5 .5 .5])";

TEST(JointPaths, ColoursShareEverything) {
  for (const char* material : {R"("diffuse" "rgb reflectance@1" [.8 .1 .1] "rgb reflectance@6" [.1 .1 .8])",
                               R"("coateddiffuse" "rgb reflectance@1" [.8 .1 .1] "rgb reflectance@6" [.1 .1 .8])"}) {
    const Statistics joint = work(material, kSteady, "true"), apart = work(material, kSteady, "false");
    EXPECT_EQ(joint.camera.segments.factor(), kFrames) << material;
    EXPECT_EQ(joint.camera.segments.separate, apart.camera.segments.separate);
    EXPECT_EQ(joint.photon.segments.separate, apart.photon.segments.separate);
    // Roulette leaves some photon paths to some frames.
    EXPECT_GT(joint.photon.segments.factor(), 0.9 * kFrames);
    EXPECT_LT(apart.photon.segments.factor(), joint.photon.segments.factor());
    EXPECT_LT(joint.photon_tests, apart.photon_tests);
    EXPECT_GT(joint.camera.weighted, 0u);
    EXPECT_GT(joint.photon.weighted, 0u);
    EXPECT_EQ(apart.camera.weighted + apart.photon.weighted, 0u);
  }
}

TEST(JointPaths, ADimmingLampSharesEverything) {
  const Statistics dims = work(kGrey, R"("point" "rgb I" [5 4 3] "float scale@1" 10 "float scale@6" 2)", "true");
  const Statistics burns = work(kGrey, kSteady, "true");
  EXPECT_EQ(dims.photon.segments.done, burns.photon.segments.done);
  EXPECT_EQ(dims.photons_stored.done, burns.photons_stored.done);
  EXPECT_EQ(dims.photons_found.done, burns.photons_found.done);
  EXPECT_EQ(dims.photon.segments.factor(), kFrames);
}

constexpr const char* kOpens = R"("spot" "rgb I" [5 5 5] "float coneangle@1" 20 "float coneangle@6" 26)";

TEST(JointPaths, AnOpeningConeSharesMost) {
  const Statistics opens = work(kGrey, kOpens, "true"), apart = work(kGrey, kOpens, "false");
  EXPECT_GT(opens.photon.segments.factor(), 0.6 * kFrames);
  EXPECT_EQ(apart.photon.segments.factor(), 1);
}

// Weights of the widest cone's photons: other noise, the same mean. 400,000 paths leave 0.2% of noise, asked for 1%.
TEST(JointPaths, AnOpeningConeKeepsItsLight) {
  TestScene test(scene(kGrey, kOpens, "true", 20000));
  const auto all = test.scene(test.all_frames());
  const auto integrator = test.integrator(*all);
  constexpr int kIterations = 20;
  for (int i = 0; i < kIterations; ++i) integrator->iterate({i, *all});
  for (const FileFrame f : test.all_frames()) {
    const auto one = test.scene({f});
    const auto alone = test.integrator(*one, "sppm");
    for (int i = 0; i < kIterations; ++i) alone->iterate({i, *one});
    const double emitted = alone->statistics().energy[0].emitted;
    EXPECT_NEAR(integrator->statistics().energy[f.slot()].emitted, emitted, 0.01 * emitted);
    const Image joint = integrator->estimate(f.index()), own = alone->estimate(0);
    double sum = 0, difference = 0;
    for (std::size_t p = 0; p < own.pixels.size(); ++p) {
      sum += static_cast<double>(luminance(own.pixels[p]));
      difference += static_cast<double>(luminance(joint.pixels[p] - own.pixels[p]));
    }
    EXPECT_LT(std::abs(difference), 0.01 * sum) << "frame " << f.index();
  }
}

/// The share of camera paths that a ball makes dynamic. It fills the image in the first frame.
double dynamic_share(const char* in_the_second_frame) {
  TestScene test(fmt::format(R"(Frames 2
Integrator "dsppm" "integer photons" 100
Camera "perspective"
Film "rgb" "integer xresolution" 24 "integer yresolution" 24
WorldBegin
LightSource "point"
DynamicBegin "ball"
  Keyframe 1 Translate 0 0 3
  Keyframe 2 Translate {}
  KeyframeEnd
  Shape "sphere" "float radius" 2.9
DynamicEnd
)",
                             in_the_second_frame));
  const auto all = test.scene(test.all_frames());
  const auto integrator = test.integrator(*all);
  integrator->iterate({0, *all});
  return integrator->statistics().camera.dynamic_share();
}

// Each of these paths ends where its frames part: no branch of it goes on in fewer frames.
TEST(JointPaths, PathsThatPartAreDynamic) {
  EXPECT_EQ(dynamic_share("0 0 -30"), 1);
  EXPECT_EQ(dynamic_share("0 0 3"), 0);
}

TEST(JointPaths, OtherDirectionsPart) {
  const Statistics glass = work(R"("dielectric" "float eta@1" 1.3 "float eta@6" 1.7)", kSteady, "true");
  EXPECT_LT(glass.camera.segments.factor(), kFrames);
}

}  // namespace joint_paths_test
}  // namespace dspm
