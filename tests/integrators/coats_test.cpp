// Glossy coats over matte ground, in every way to find direct light: a surface of two kinds of lobes chooses between them,
// and every way must know with which chance. Path tracing, which does not choose, tells what is right.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "dspm/base/math/sphere_mapping.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "tests/lights/environment.h"
#include "tests/support/seeds.h"

namespace dspm::test {
namespace coats_test {

constexpr double kAlphas[] = {0.03, 0.06, 0.09, 0.13, 0.2, 0.35, 0.6, 1};
constexpr int kPatches = 4;  // along each side of the picture

/// Sixteen coats, one for each tile of the picture: those of the alphas as coateddiffuse, and as principled.
std::string coats() {
  std::string text;
  for (int i = 0; i < kPatches * kPatches; ++i) {
    const double alpha = kAlphas[i % 8];
    text += i < 8 ? fmt::format(
                        "Material \"coateddiffuse\" \"rgb reflectance\" [.6 .4 .2] \"float roughness\" {} "
                        "\"bool remaproughness\" false\n",
                        alpha)
                  : fmt::format(
                        "Material \"principled\" \"rgb basecolor\" [.6 .4 .2] \"float roughness\" 1 "
                        "\"float coat\" 1 \"float coatroughness\" {}\n",
                        std::sqrt(alpha));
    // The outer ones reach further, so that no photon is missed at an edge.
    const auto edge = [](int k) { return k == 0 ? -3 : k == kPatches ? 3 : 0.5 * k - 1; };
    const int column = i % kPatches, row = i / kPatches;
    text += fmt::format(
        "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [{0} {2} 0 {1} {2} 0 "
        "{1} {3} 0 {0} {3} 0]\n",
        edge(column), edge(column + 1), edge(row), edge(row + 1));
  }
  return text;
}

/// The camera sees the patches from 45 degrees; what it sees mirrored comes from (1, 0, 1).
std::string scene(const std::string& integrator, const std::string& light) {
  return fmt::format(R"(
Integrator {} "integer maxdepth" 3
LookAt -4 0 4  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-.70710678 .70710678 -1 1]
PixelFilter "box"
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
{}
)",
                     integrator, light) +
         coats();
}

constexpr const char* kPoint = R"(LightSource "point" "rgb I" [300 300 300] "point3 from" [12 0 12])";
constexpr const char* kSpot =
    R"(LightSource "spot" "rgb I" [300 300 300] "point3 from" [12 0 12] "point3 to" [0 0 0] "float coneangle" 8
       "float conedeltaangle" 1)";
constexpr const char* kSun = R"(LightSource "distant" "rgb L" [1 1 1] "point3 from" [1 0 1] "point3 to" [0 0 0])";
constexpr const char* kLamp = R"(
AttributeBegin
  Translate 3 0 3 Rotate 225 0 1 0 AreaLightSource "diffuse" "rgb L" [9 9 9] Shape "disk" "float radius" .3
AttributeEnd)";
constexpr const char* kSky = R"(LightSource "infinite" "rgb L" [1 1 1])";

/// A dim sky with a sun of one pixel's width where the camera looks.
std::string sunny_sky(const EnvironmentFile& file) {
  return fmt::format("LightSource \"infinite\" \"string filename\" \"{}\"\n", file.path());
}
Image sunny_picture() {
  Image image(32, 32);
  std::fill(image.pixels.begin(), image.pixels.end(), Rgb(0.2f));
  const Vec2 sun = place_of(SphereMapping::equal_area, normalize(Vec3{1, 0, 1}));
  image.at(static_cast<int>(sun.x * 32), static_cast<int>(sun.y * 32)) = Rgb(300);
  return image;
}

/// Paths choose a thin coat seldom, so it takes many of them to tell a tenth of its highlight from noise. `often`: by how
/// many more, if the light has an extent.
void expect_as_by_path(const std::string& light, int often) {
  const struct {
    const char* name;
    int iterations;
  } integrators[] = {
      {R"("dsppm" "integer photons" 200 "float radius" .2 "string direct" "both")", 24 * often},
      {R"("dsppm" "integer photons" 20 "string direct" "sampled")", 96 * often},
      {R"("dsppm" "integer photons" 3000 "float radius" .2 "string direct" "photons")", 12},
      {R"("vcm" "integer photons" 64)", 24},
  };
  const int times = seeds(8);
  const Tiles path = rendered(scene("\"path\"", light), 128 * often, times);
  for (const auto& [integrator, iterations] : integrators) {
    const Verdict verdict = agreement(rendered(scene(integrator, light), iterations, times), path, {0.01 / 24, 0.01});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

TEST(Coats, UnderAPoint) { expect_as_by_path(kPoint, 1); }
TEST(Coats, UnderASpot) { expect_as_by_path(kSpot, 1); }
TEST(Coats, UnderTheSun) { expect_as_by_path(kSun, 1); }
TEST(Coats, UnderALamp) { expect_as_by_path(kLamp, 8); }
TEST(Coats, UnderASky) { expect_as_by_path(kSky, 2); }
TEST(Coats, UnderAPictureOfASunnySky) {
  const EnvironmentFile file(sunny_picture());
  expect_as_by_path(sunny_sky(file), 2);
}

// The camera sees a wall, which a coated floor lights: photons chose there.
TEST(Coats, ThrowTheirLightOnAWall) {
  const auto scene = [](const std::string& integrator) {
    return fmt::format(R"(
Integrator {} "integer maxdepth" 2
LookAt 0 1 -3  0 1 0  0 1 0
Camera "orthographic" "float screenwindow" [-1 1 -.8 .8]
PixelFilter "box"
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "spot" "rgb I" [60 60 60] "point3 from" [0 3 -2] "point3 to" [0 0 -1] "float coneangle" 14
Material "diffuse"
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-3 0 0  3 0 0  3 4 0  -3 4 0]
Material "coateddiffuse" "rgb reflectance" [.3 .3 .3] "float roughness" .08 "bool remaproughness" false
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-3 0 0  -3 0 -3  3 0 -3  3 0 0]
)",
                       integrator);
  };
  const int times = seeds(8);
  const Tiles path = rendered(scene("\"path\""), 256, times, 2);
  for (const char* indirect : {"photons", "paths"})
    for (const char* direct : {"both", "photons"}) {
      const std::string integrator =
          fmt::format(R"("dsppm" "integer photons" 4000 "float radius" .3 "string indirect" "{}" "string direct" "{}")",
                      indirect, direct);
      const Verdict verdict = agreement(rendered(scene(integrator), 16, times, 2), path, {0.01 / 4, 0.01});
      EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
    }
}

// Grounds whose brightness changes from frame to frame are chosen with another chance in each, though frames share hit
// points.
TEST(Coats, OverGroundsOfOneColourEachAsAlone) {
  for (const char* material :
       {R"("coateddiffuse" "rgb reflectance@1" [.8 .7 .6] "rgb reflectance@3" [.2 .3 .1] "float roughness" 0)",
        R"("coateddiffuse" "rgb reflectance@1" [.8 .8 .8] "rgb reflectance@3" [.1 .1 .1] "float roughness" .06
           "bool remaproughness" false)",
        R"("principled" "rgb basecolor@1" [.8 .8 .8] "rgb basecolor@3" [.1 .1 .1] "float roughness" .2)"})
    for (const char* direct : {"both", "sampled", "photons"}) {
      const Verdict verdict = check_joint(fmt::format(R"(
Frames 3
Integrator "dsppm" "integer photons" 2000 "string direct" "{}"
LookAt -4 0 4  0 0 0  0 1 0
Camera "orthographic"
Film "rgb" "integer xresolution" 12 "integer yresolution" 12
WorldBegin
{}
Material {}
Shape "disk" "float radius" 3
)",
                                                      direct, kLamp, material));
      EXPECT_TRUE(verdict.passed) << direct << ", " << material << ": " << verdict.message;
    }
}

}  // namespace coats_test
}  // namespace dspm::test
