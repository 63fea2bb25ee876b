// "bool shadowcatcher": shadows as alpha, whose answer is known, and images that lie over what they were taken out of.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/base/system/state_in_memory.h"
#include "dspm/integrators/beside/surface_output_list.h"
#include "dspm/integrators/caught_light.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace shadow_catcher_test {

using test::TestScene;

constexpr const char* kIntegrators[] = {
    R"("path" "integer maxdepth" 4)",
    R"("vcm" "integer maxdepth" 4 "integer photons" 4000)",
    R"("dsppm" "integer photons" 4000 "float radius" 0.1)",
    R"("dsppm" "integer photons" 16000 "float radius" 0.3 "string estimator" "hj09" "string direct" "photons")",
    R"("sppm" "integer photons" 4000 "float radius" 0.1)",
    R"("photonmap" "integer photons" 8000 "integer causticphotons" 8000)",
};

/// Looks at the floor under a ball that moves up and is gone in frame 3.
std::string scene(const std::string& integrator, const std::string& catcher, const std::string& material,
                  const std::string& aim = "LookAt 0 -6 1  0 0 0  0 0 1", const char* fov = "0.5") {
  return fmt::format(R"(
Frames 3
Integrator {}
{}
Camera "perspective" "float fov" {}
Film "rgb" "integer xresolution" 8 "integer yresolution" 8 "bool transparent" true
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
AttributeBegin
  Material "diffuse" "rgb reflectance" [.5 .5 .5]
  Shape "disk" "float radius" 9 {}
AttributeEnd
DynamicBegin "ball" "integer frames" [1 2]
  Keyframe 1 Translate 0 0 1.5 Keyframe 2 Translate 0 0 3 KeyframeEnd
  {}
  Shape "sphere" "float radius" 0.75
DynamicEnd
)",
                     integrator, aim, fov, catcher, material);
}

constexpr const char* kCatches = R"("bool shadowcatcher" true)";
constexpr const char* kBlack = R"(Material "diffuse" "rgb reflectance" [0 0 0])";

/// By frame: after some iterations.
struct Seen {
  std::vector<Image> alpha, radiance;
};
Rgb mean_of(const Image& image) {
  Rgb sum;
  for (const Rgb& pixel : image.pixels) sum += pixel / static_cast<float>(image.pixels.size());
  return sum;
}
Seen seen(const std::string& text, int iterations) {
  TestScene test(text);
  Seen seen;
  for (const std::vector<FileFrame>& frames : test.intervals()) {
    const std::unique_ptr<Scene> of_frames = test.scene(frames);
    const std::unique_ptr<Integrator> integrator = test.integrator(*of_frames);
    for (int i = 0; i < iterations; ++i) integrator->iterate({i, *of_frames});
    for (Frame f = 0; f < of_frames->frame_count(); ++f) {
      seen.alpha.push_back(integrator->estimate(f, kAlphaOutput));
      seen.radiance.push_back(integrator->estimate(f));
    }
  }
  return seen;
}

// A ball of radius R at height h hides (R/h)^2 of what a sky sends to the point under it.
TEST(ShadowCatcher, AlphaIsTheShareOfTheSkyThatABallHides) {
  for (const char* integrator : kIntegrators) {
    const Seen images = seen(scene(integrator, kCatches, kBlack), 96);
    ASSERT_EQ(images.alpha.size(), 3) << integrator;
    EXPECT_NEAR(mean_of(images.alpha[0]).r, 0.25, 0.02) << integrator;
    EXPECT_NEAR(mean_of(images.alpha[1]).r, 0.0625, 0.015) << integrator;
    EXPECT_NEAR(mean_of(images.alpha[2]).r, 0, 1e-4) << integrator;  // without noise
    for (const Image& radiance : images.radiance) EXPECT_LT(max_component(mean_of(radiance)), 2e-3f) << integrator;
  }
}

// Smoke of depth s dims the sun on its way to the floor, and the floor on its way to the camera: exp(-2 s) is left.
TEST(ShadowCatcher, AlphaIsWhatSmokeTakes) {
  for (const char* integrator : kIntegrators) {
    const Seen images = seen(fmt::format(R"(
Integrator {}
LookAt 0 0 5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-1 1 -1 1]
Film "rgb" "integer xresolution" 8 "integer yresolution" 8 "bool transparent" true
WorldBegin
LightSource "distant" "rgb L" [1 1 1] "point3 from" [0 0 1] "point3 to" [0 0 0]
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Shape "disk" "float radius" 9 "bool shadowcatcher" true
MakeNamedMedium "smoke" "string type" "homogeneous" "rgb sigma_s" [0 0 0] "rgb sigma_a" [.4 .4 .4]
MediumInterface "smoke" ""
Material "interface"
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7]
  "point3 P" [-4 -4 1  4 -4 1  4 4 1  -4 4 1  -4 -4 2  4 -4 2  4 4 2  -4 4 2])",
                                         integrator),
                             32);
    EXPECT_NEAR(mean_of(images.alpha[0]).r, 1 - std::exp(-0.8f), 0.02) << integrator;
    EXPECT_LT(max_component(mean_of(images.radiance[0])), 5e-3f) << integrator;
  }
}

// With the floor itself behind it, in the frame without the ball, the image is what the floor looks like: shadows, the
// colour that the ball throws onto it, and caustics.
TEST(ShadowCatcher, OverTheBareFloorLiesTheFloorWithItsLight) {
  for (const char* integrator : kIntegrators)
    for (const char* material : {R"(Material "diffuse" "rgb reflectance" [.8 .1 .1])", R"(Material "dielectric")"}) {
      const Seen plain = seen(scene(integrator, "", material), 4),
                 caught = seen(scene(integrator, kCatches, material), 4);
      for (std::size_t f = 0; f < 3; ++f) {
        Image over = caught.radiance[f];
        for (std::size_t i = 0; i < over.pixels.size(); ++i)
          over.pixels[i] += plain.radiance[2].pixels[i] * (1 - caught.alpha[f].pixels[i].r);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(mean_of(over)[c], mean_of(plain.radiance[f])[c], 1e-5f) << integrator << ", frame " << f;
      }
    }
}

// The colour that loses most of its light loses all that alpha takes, so rounding may leave less than nothing: a checkpoint
// with such a pixel counts as damaged.
TEST(ShadowCatcher, NoPixelIsNegative) {
  for (const char* integrator : kIntegrators)
    for (const Image& radiance : seen(scene(integrator, kCatches, R"(Material "dielectric")"), 3).radiance)
      for (const Rgb& pixel : radiance.pixels) EXPECT_GE(std::min({pixel.r, pixel.g, pixel.b}), 0) << integrator;
}

TEST(ShadowCatcher, ThingsHideIt) {
  const Seen images = seen(scene(kIntegrators[0], kCatches, R"(Material "diffuse" "rgb reflectance" [.8 .8 .8])",
                                 "LookAt 0 -6 1.5  0 0 1.5  0 0 1"),
                           4);
  EXPECT_EQ(mean_of(images.alpha[0]).r, 1);
  EXPECT_GT(mean_of(images.radiance[0]).r, 0.4f);
}

TEST(ShadowCatcher, AFrameAloneIsThatOfTheJointRun) {
  TestScene test(scene(kIntegrators[2], kCatches, kBlack));
  const auto frames = test.all_frames();
  const auto all = test.scene(frames), alone = test.scene({frames[1]});
  const auto joint = test.integrator(*all), single = test.integrator(*alone);
  for (int i = 0; i < 3; ++i) joint->iterate({i, *all}), single->iterate({i, *alone});
  for (const char* output : {kRadiance, kAlphaOutput}) {
    const Image a = joint->estimate(1, output), b = single->estimate(0, output);
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.pixels[i][c], b.pixels[i][c], 1e-4f) << output;
  }
}

TEST(ShadowCatcher, ItsStateComesBack) {
  TestScene test(scene(kIntegrators[2], kCatches, kBlack));
  const auto all = test.scene(test.all_frames());
  const auto whole = test.integrator(*all), resumed = test.integrator(*all);
  for (int i = 0; i < 2; ++i) whole->iterate({i, *all});
  const std::string saved = state_of(*whole);
  LoadedState state(saved);
  ASSERT_TRUE(resumed->persist(state));
  EXPECT_TRUE(state.all_read());
  whole->iterate({2, *all}), resumed->iterate({2, *all});
  for (const char* output : {kRadiance, kAlphaOutput})
    EXPECT_EQ(whole->estimate(0, output), resumed->estimate(0, output)) << output;
}

TEST(ShadowCatcher, IntegratorsThatDoNotKnowItSaySo) {
  try {
    seen(scene(R"("ambientocclusion")", kCatches, kBlack), 1);
    FAIL() << "there was no error";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("knows no shadow catchers"), std::string::npos) << error.what();
  }
}

}  // namespace shadow_catcher_test
}  // namespace dspm
