// Light that rough surfaces throw on one another, by camera paths that go on from hit points: the same images as by
// photons, and chosen where photons would be few.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace indirect_light_test {

/// A corner with clear glass, a glossy and a coated ball, under a sky and a wide lamp, so that path finds all light.
std::string corner(const std::string& integrator, const char* frames = "Frames 2") {
  return fmt::format(R"({}
Integrator {}
LookAt 0 1 4  0 .6 0  0 1 0
Camera "perspective" "float fov" 50
PixelFilter "box"
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "infinite" "rgb L" [.4 .5 .6]
AttributeBegin
  Translate 1 3 1 Rotate 90 1 0 0 AreaLightSource "diffuse" "rgb L" [6 5 4] "bool twosided" true Shape "disk" "float radius" 1
AttributeEnd
Material "diffuse" "rgb reflectance" [.7 .6 .5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3  4 5 6 4 6 7]
  "point3 P" [-3 0 -1  -3 0 3  3 0 3  3 0 -1   -3 0 -1  3 0 -1  3 3 -1  -3 3 -1]
AttributeBegin Translate -1.1 .5 .2 Material "dielectric" "float eta" 1.5 Shape "sphere" "float radius" .5 AttributeEnd
AttributeBegin
  Translate 1.1 .5 .2 Material "conductor" "float roughness" .15 "bool remaproughness" false Shape "sphere" "float radius" .5
AttributeEnd
DynamicBegin "ball"
  Keyframe 1 Translate -.1 .5 .3 Keyframe 2 Translate .2 .6 .3 KeyframeEnd
  Material "coateddiffuse" "rgb reflectance@1" [.2 .6 .3] "rgb reflectance@2" [.6 .2 .3] "float roughness" .1
  Shape "sphere" "float radius" .45
DynamicEnd
)",
                     frames, integrator);
}

TEST(IndirectLight, ByPathsIsWhatPathFinds) {
  const Tiles path = rendered(corner(R"("path" "integer maxdepth" 12)"), 256, 16, 2);
  for (const char* direct : {"both", "sampled", "photons"}) {
    const std::string words = fmt::format(
        R"("dsppm" "integer photons" 10000 "integer maxdepth" 12 "float radius" .05 "string indirect" "paths" "string direct" "{}")",
        direct);
    const Verdict verdict = agreement(rendered(corner(words), 24, 16, 2), path, {0.01 / 3, 0.012});
    EXPECT_TRUE(verdict.passed) << direct << ": " << verdict.message;
  }
}

TEST(IndirectLight, ByPathsKeepsThePromises) {
  const std::string text = corner(R"("dsppm" "integer photons" 2000 "string indirect" "paths")");
  for (const Verdict& verdict :
       {check_threads(text, 2), check_resume(text, 3), check_joint(text, 2), check_crop(text, 2)})
    EXPECT_TRUE(verdict.passed) << verdict.message;
}

/// Photons stored in the first iteration.
std::uint64_t stored(const std::string& text) {
  TestScene test(text);
  const auto scene = test.scene(test.all_frames());
  const auto made = test.integrator(*scene);
  made->iterate({0, *scene});
  return made->statistics().photons_stored.done;
}

// A ball on a wide ground: hardly a photon finds its way from the ground to the ball. In a white box all do, but hardly a
// camera path finds the small place that a spot lights.
TEST(IndirectLight, IsFoundByPathsUnderTheSkyAndByPhotonsInABox) {
  const auto scene = [](const char* indirect, const char* things, int photons = 20000) {
    return fmt::format(R"(
Integrator "dsppm" "integer photons" {} "string indirect" "{}"
LookAt 0 1 4  0 .6 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 64 "integer yresolution" 64
WorldBegin
{}
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Translate 0 .5 0 Shape "sphere" "float radius" .5
)",
                       photons, indirect, things);
  };
  const char* sky = R"(
LightSource "infinite" "rgb L" [.5 .6 .8]
AttributeBegin Rotate 90 1 0 0 Material "diffuse" "rgb reflectance" [.5 .5 .5] Shape "disk" "float radius" 200 AttributeEnd)";
  const char* box = R"(
LightSource "spot" "rgb I" [99 99 99] "point3 from" [0 2 1] "point3 to" [0 5 1] "float coneangle" 9 "float conedeltaangle" 3
AttributeBegin Material "diffuse" "rgb reflectance" [.8 .8 .8] ReverseOrientation Shape "sphere" "float radius" 5 AttributeEnd)";
  EXPECT_EQ(stored(scene("auto", sky)), 0u);
  EXPECT_GT(stored(scene("auto", box)), 0u);
}

}  // namespace indirect_light_test
}  // namespace dspm::test
