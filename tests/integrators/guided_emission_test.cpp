// Photons that start where they are found: on scenes where hardly any would be found without a guide, images converge
// to what is known, and all of dspm's promises hold.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/integrators/guiding/learn_emission.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace guided_emission_test {

/// A sun and a sky over a wide ground, of which the camera sees 2 x 2 beside its centre.
std::string ground(const std::string& integrator, const std::string& things = "", const char* frames = "",
                   int radius = 100) {
  return fmt::format(R"({}
Integrator {}
LookAt 5 3 2  5 3 0  0 1 0
Camera "orthographic" "float screenwindow" [-1 1 -1 1]
PixelFilter "box"
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "infinite" "rgb L" [.6 .6 .6]
LightSource "distant" "rgb L" [3 3 3] "point3 from" [3 0 4] "point3 to" [0 0 0]
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Shape "disk" "float radius" {}
{})",
                     frames, integrator, radius, things);
}

constexpr const char* kBall = R"(
DynamicBegin "ball"
Keyframe 1 Translate 4.6 3 .5 Keyframe 3 Translate 5.2 3 .5 KeyframeEnd
Material "dielectric"
Shape "sphere" "float radius" .4
DynamicEnd
Translate 5.6 3.5 .3
Shape "sphere" "float radius" .3
)";

// E = L cos of the sun and pi L of the sky; one part in 8000 of the ground is seen.
TEST(GuidedEmission, EndlessGround) {
  const double radiance = 0.5 / std::numbers::pi * (3 * 0.8 + 0.6 * std::numbers::pi);
  for (const char* integrator : {R"("dsppm" "integer photons" 20000)", R"("sppm" "integer photons" 20000)",
                                 R"("dsppm" "integer photons" 20000 "string estimator" "hj09")"}) {
    const Verdict verdict =
        agreement(rendered(ground(integrator), 4, 16, 2), Rgb(static_cast<float>(radiance)), {0.01 / 3, 0.002});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

// On a smaller ground: light that far ground throws onto the ball comes in few strong photons, too few for a t-test.
TEST(GuidedEmission, ConvergesToWhatPathFinds) {
  constexpr int kRadius = 10;
  const std::string ball = "Translate 5 3 .5 Shape \"sphere\" \"float radius\" .5";
  const Tiles path = rendered(ground(R"("path" "integer maxdepth" 4)", ball, "", kRadius), 128, 16, 2);
  for (const char* direct : {"both", "photons", "sampled"}) {
    const std::string words = fmt::format(
        R"("dsppm" "integer photons" 15000 "integer maxdepth" 4 "float radius" .03 "string direct" "{}")", direct);
    const Verdict verdict = agreement(rendered(ground(words, ball, "", kRadius), 8, 16, 2), path, {0.01 / 2, 0.01});
    EXPECT_TRUE(verdict.passed) << direct << ": " << verdict.message;
  }
}

TEST(GuidedEmission, KeepsThePromises) {
  for (const char* integrator : {R"("dsppm" "integer photons" 5000)", R"("sppm" "integer photons" 5000)",
                                 R"("photonmap" "integer photons" 5000 "integer causticphotons" 5000)"}) {
    const std::string text = ground(integrator, kBall, "Frames 3");
    for (const Verdict& verdict :
         {check_threads(text, 2), check_resume(text, 3), check_joint(text, 2), check_crop(text, 2)})
      EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

/// A lawn under a sky of radiance 0.5, to the horizon, of which the camera sees what is near: rows at the picture's
/// upper edge see much more of it than others.
std::string lawn(int seed, const std::string& direct) {
  return fmt::format(R"(
Integrator "dsppm" "integer photons" 40000 "integer seed" {} "string direct" "{}"
LookAt 0 3.2 -7.2  0 -0.7 0  0 1 0
Camera "perspective" "float fov" 42
Film "rgb" "integer xresolution" 64 "integer yresolution" 36
WorldBegin
LightSource "infinite" "rgb L" [.5 .5 .5]
Material "diffuse" "rgb reflectance" [.5 .5 .5]
AttributeBegin Translate 0 .29 0 Rotate -90 1 0 0 Shape "disk" "float radius" 700 AttributeEnd
)",
                     seed, direct);
}

// The guide sends hardly a photon to the upper edge, and one that starts by power brings a pixel thirty times the light
// that it should have: so with seeds 0, 1 and 3 if no rays bound its weight.
TEST(GuidedEmission, NoPhotonOutweighsTheOthersAtAnEdgeOfThePicture) {
  for (int seed = 0; seed < 4; ++seed) {
    TestScene test(lawn(seed, "both"));
    const Image image = test.render(test.all_frames().front(), 4);
    float most = 0;
    for (const Rgb& pixel : image.pixels) most = std::max(most, luminance(pixel));
    EXPECT_LT(most, 2 * 0.25f) << seed;
  }
}

/// Found photons of the integrator's first iteration, and whether a guide was learned for it.
SharedCount found(const std::string& integrator) {
  TestScene test(ground(integrator, kBall, "Frames 3"));
  const auto scene = test.scene(test.all_frames());
  const auto made = test.integrator(*scene);
  made->iterate({0, *scene});
  return made->statistics().photons_found;
}

TEST(GuidedEmission, FindsAThousandTimesMore) {
  for (const char* direct : {"both", "photons", "sampled"}) {
    const std::string start =
        fmt::format(R"("dsppm" "string indirect" "photons" "integer photons" 50000 "string direct" "{}")", direct);
    EXPECT_GT(found(start).done, 1000 * (found(start + R"( "string emission" "power")").done + 1)) << direct;
  }
}

}  // namespace guided_emission_test
}  // namespace dspm::test
