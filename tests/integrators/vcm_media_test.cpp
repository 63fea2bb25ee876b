// Subpaths that collide with media, are connected and merged there: every way to find light gives the image of `path`, or
// where that finds none, of `dsppm`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/testing/compare.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace vcm_media_test {

using test::TestScene;

/// Fog or a cloud in a ball, over a floor, with a glass ball in it and what `more` adds; 8 x 8 pixels.
std::string scene(const std::string& integrator, const std::string& medium, const std::string& more) {
  return fmt::format(R"(
Integrator {}
PixelFilter "box"
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
LookAt 0 .5 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
WorldBegin
MakeNamedMedium "fog" {}
AttributeBegin MediumInterface "fog" "" Material "interface" Shape "sphere" "float radius" 1.2 AttributeEnd
AttributeBegin Material "dielectric" Translate .5 .3 -.3 Shape "sphere" "float radius" .3 AttributeEnd
AttributeBegin Material "diffuse" "rgb reflectance" [.7 .5 .4] Translate 0 -1.4 0 Rotate -90 1 0 0
  Shape "disk" "float radius" 4 AttributeEnd
{}
)",
                     integrator, medium, more);
}

const char* const kFog =
    R"("string type" "homogeneous" "rgb sigma_a" [.1 .2 .1] "rgb sigma_s" [.8 .5 1.2] "float g" .3)";
const char* const kCloud = R"("string type" "uniformgrid" "integer nx" 2 "integer ny" 2 "integer nz" 2
  "float density" [1 0 2 3 2 0 0 2] "point3 p0" [-1 -1 -1] "rgb sigma_a" [.1 .1 .1] "rgb sigma_s" [.8 1 .6])";
const char* const kLamp = R"(AttributeBegin Translate -.4 1.6 -.2 AreaLightSource "diffuse" "rgb L" [12 9 7]
  Shape "sphere" "float radius" .3 AttributeEnd)";

Rgb seen(const std::string& text, int iterations) { return mean(TestScene(text).render(FileFrame(0), iterations)); }

void expect_same(const Rgb& found, const Rgb& expected, double error, const std::string& which) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(static_cast<double>(found[c] / expected[c]), 1, error) << which << c;
}

TEST(VcmInMedia, FindsWhatPathFindsInEachWay) {
  for (const char* medium : {kFog, kCloud}) {
    const Rgb expected = seen(scene(R"("path" "integer maxdepth" 6)", medium, kLamp), 3000);
    for (const char* ways :
         {"", R"("bool connect" false)", R"("bool merge" false)", R"("bool lighttracing" false)",
          R"("bool connect" false "bool lighttracing" false)", R"("bool connect" false "bool merge" false)"})
      expect_same(
          seen(scene(fmt::format(R"("vcm" "integer maxdepth" 6 "integer photons" 400 "float radius" .05 {})", ways),
                     medium, kLamp),
               600),
          expected, 0.035, fmt::format("{} {}", medium, ways));
  }
}

// What light of a spot does behind glass is found by light subpaths alone: from the camera, and by merges in a mirror.
TEST(VcmInMedia, FindsCausticsInFogAndThatInAMirror) {
  const char* const spot = R"(LightSource "spot" "rgb I" [30 30 30] "point3 from" [.5 2.5 -.3] "point3 to" [.5 0 -.3]
  "float coneangle" 9)";
  const char* const mirror =
      R"(AttributeBegin Material "conductor" "float roughness" 0 Translate -1.5 0 1 Rotate 50 0 1 0
  Shape "disk" "float radius" 1.5 AttributeEnd)";
  for (const std::string& more : {std::string(spot), std::string(spot) + "\n" + mirror}) {
    const Rgb expected =
        seen(scene(R"("dsppm" "integer maxdepth" 5 "integer photons" 60000 "float radius" .05)", kFog, more), 40);
    expect_same(seen(scene(R"("vcm" "integer maxdepth" 5 "integer photons" 3000 "float radius" .02)", kFog, more), 400),
                expected, 0.05, more);
  }
}

}  // namespace vcm_media_test
}  // namespace dspm
