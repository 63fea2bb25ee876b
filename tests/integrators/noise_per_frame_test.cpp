// "noise" "perframe": where the camera moves, frames have noise of their own; all else stays as it is.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace noise_per_frame_test {

/// A ground under a sky: every pixel is 0.25, wherever the camera is.
std::string ground(const std::string& integrator, const std::string& noise, const std::string& camera,
                   const std::string& things = "") {
  return fmt::format(R"(
Frames 3
Integrator {} "string noise" "{}"
{}
Camera "orthographic" "float screenwindow" [-1 1 -1 1]
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
WorldBegin
LightSource "infinite" "rgb L" [.5 .5 .5]
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Shape "disk" "float radius" 100
{})",
                     integrator, noise, camera, things);
}

constexpr const char* kMoves = R"(
Keyframe 1 LookAt 0 0 2  0 0 0  0 1 0
Keyframe 3 LookAt 1 0 2  1 0 0  0 1 0
KeyframeEnd)";
constexpr const char* kStands = "LookAt 0 0 2  0 0 0  0 1 0";
constexpr const char* kBall = R"(
DynamicBegin "ball"
Keyframe 1 Translate -.5 0 .3 Keyframe 3 Translate .5 0 .3 KeyframeEnd
Shape "sphere" "float radius" .2
DynamicEnd)";
constexpr const char* kPath = R"("path" "integer maxdepth" 1)";

/// Of the errors of two frames that ought to be 0.25 everywhere.
double correlation(const Image& a, const Image& b) {
  double product = 0, squares_a = 0, squares_b = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double error_a = static_cast<double>(luminance(a.pixels[i])) - 0.25,
                 error_b = static_cast<double>(luminance(b.pixels[i])) - 0.25;
    product += error_a * error_b, squares_a += error_a * error_a, squares_b += error_b * error_b;
  }
  return product / std::sqrt(squares_a * squares_b);
}

// Of 1,024 independent pixels, the correlation has a deviation of 0.031.
TEST(NoisePerFrame, IsAnotherWhereTheCameraMoves) {
  const std::vector<Image> frozen = TestScene(ground(kPath, "frozen", kMoves)).render_all(2),
                           own = TestScene(ground(kPath, "perframe", kMoves)).render_all(2);
  EXPECT_GT(correlation(frozen[0], frozen[1]), 0.99);
  for (const std::size_t later : {1u, 2u}) EXPECT_LT(std::abs(correlation(own[0], own[later])), 5 * 0.031) << later;
}

// What moves must not boil in a picture that stands still.
TEST(NoisePerFrame, IsFrozenWhereTheCameraStands) {
  const std::vector<Image> images = TestScene(ground(kPath, "perframe", kStands, kBall)).render_all(2);
  int same = 0;
  for (std::size_t i = 0; i < images[0].pixels.size(); ++i) same += images[0].pixels[i] == images[2].pixels[i];
  EXPECT_GT(same, 300);  // the ball casts no light away from itself on most of the rest
}

TEST(NoisePerFrame, KeepsThePromisesAndSharesPhotons) {
  const std::string photons = R"("dsppm" "string indirect" "photons" "integer photons" 2000)";
  const std::string text = ground(photons, "perframe", kMoves, kBall);
  for (const Verdict& verdict :
       {check_threads(text, 2), check_resume(text, 2), check_joint(text, 2), check_crop(text, 2)})
    EXPECT_TRUE(verdict.passed) << verdict.message;
  double factors[2];
  for (const bool own : {false, true}) {
    TestScene test(ground(photons, own ? "perframe" : "frozen", kMoves, kBall));
    const auto scene = test.scene(test.all_frames());
    const auto made = test.integrator(*scene);
    made->iterate({0, *scene});
    factors[own] = made->statistics().photon.segments.factor();
  }
  EXPECT_NEAR(factors[1], factors[0], 0.02 * factors[0]);
  EXPECT_GT(factors[1], 2.5);
}

}  // namespace noise_per_frame_test
}  // namespace dspm::test
