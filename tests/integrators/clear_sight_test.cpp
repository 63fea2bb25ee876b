// What denoisers are told of surfaces in mirrors and behind glass, against analytic values.
#include "dspm/integrators/transport/clear_sight.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "dspm/image/image.h"
#include "dspm/session/job/choices.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace clear_sight_test {

using test::TestScene;

/// What one pixel sees along +z from the origin.
std::map<std::string, Rgb> seen(const std::string& shapes, std::size_t frame = 0) {
  Choices choices;
  choices.outputs = {"N", "Z", "albedo", "denoisingN", "denoisingZ", "denoisingalbedo"};
  TestScene test(R"(
Frames 2
Option "disablepixeljitter" true
Integrator "path"
Camera "orthographic"
Film "rgb" "integer xresolution" 1 "integer yresolution" 1
WorldBegin
LightSource "point"
)" + shapes,
                 choices);
  const auto scene = test.scene(test.all_frames());
  const auto integrator = test.integrator(*scene);
  for (int i = 0; i < 8; ++i) integrator->iterate({i, *scene});
  std::map<std::string, Rgb> values;
  for (const std::string& output : choices.outputs)
    values[output] = integrator->estimate(static_cast<Frame>(frame), output).at(0, 0);
  return values;
}

void expect_near(const Rgb& value, const Rgb& expected, float tolerance = 1e-3f) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], tolerance) << "component " << c;
}

const std::string kWall = R"(
AttributeBegin
  Translate 0 0 5
  Material "diffuse" "rgb reflectance" [.2 .4 .6]
  Shape "disk" "float radius" 50
AttributeEnd
)";
/// At a depth of 2, across the way.
std::string pane(const std::string& material) {
  return "AttributeBegin Translate 0 0 2 Material " + material + R"( Shape "disk" "float radius" 3 AttributeEnd)";
}

TEST(ClearSight, OfTheFirstSurfaceIsThatIfItIsRough) {
  for (const char* material : {R"("diffuse" "rgb reflectance" [.5 .5 .5])",
                               R"("coateddiffuse" "rgb reflectance" [.5 .5 .5] "float roughness" 0)"}) {
    const auto values = seen(pane(material) + kWall);
    EXPECT_EQ(values.at("denoisingN"), values.at("N")) << material;
    EXPECT_EQ(values.at("denoisingZ").r, values.at("Z").r) << material;
    EXPECT_EQ(values.at("denoisingalbedo"), values.at("albedo")) << material;
  }
}

TEST(ClearSight, PassesGlass) {
  for (const char* glass : {R"("dielectric" "float eta" 1.5)", R"("thindielectric" "float eta" 1.5)"}) {
    const auto values = seen(pane(glass) + kWall);
    EXPECT_NEAR(values.at("Z").r, 2, 1e-4) << glass;
    EXPECT_NEAR(values.at("denoisingZ").r, 5, 1e-4) << glass;
    expect_near(values.at("denoisingN"), {0, 0, -1});
    expect_near(values.at("denoisingalbedo"), {.2f, .4f, .6f});
  }
}

// The mirror looks sideways, at a wall 3 away that the camera does not see.
TEST(ClearSight, TurnsAtMirrors) {
  const std::string mirror = R"(
AttributeBegin
  Translate 0 0 2
  Rotate 45 0 1 0
  Material "conductor" "rgb reflectance" [.5 1 .25] "float roughness" 0
  Shape "disk" "float radius" 1
AttributeEnd
AttributeBegin
  Rotate 90 0 1 0
  Material "diffuse" "rgb reflectance" [.2 .4 .6]
  Translate 0 0 {}
  Shape "disk" "float radius" 50
AttributeEnd
)";
  for (const char* side : {"3", "-3"}) {
    const auto values = seen(fmt::format(fmt::runtime(mirror), side));
    EXPECT_NEAR(values.at("Z").r, 2, 1e-4);
    if (values.at("denoisingZ").r > 100) continue;  // the wall is on the other side
    EXPECT_NEAR(values.at("denoisingZ").r, 5, 1e-4);
    EXPECT_NEAR(std::abs(values.at("denoisingN").r), 1, 1e-4);
    expect_near(values.at("denoisingalbedo"), {.1f, .4f, .15f}, .02f);  // metals are brighter at 45 degrees
    return;
  }
  FAIL() << "no wall in the mirror";
}

TEST(ClearSight, OfNothingIsWhite) {
  const auto nothing = seen("");
  expect_near(nothing.at("denoisingalbedo"), Rgb(1));
  EXPECT_EQ(nothing.at("denoisingN"), Rgb());
  EXPECT_EQ(nothing.at("denoisingZ").r, 1e10f);
  const auto mirrored = seen(pane(R"("conductor" "rgb reflectance" [.5 1 .25] "float roughness" 0)"));
  expect_near(mirrored.at("denoisingalbedo"), {.5f, 1, .25f});
  EXPECT_EQ(mirrored.at("denoisingZ").r, 1e10f);
}

TEST(ClearSight, OfALampIsWhiteAsWell) {
  const auto values = seen(R"(AreaLightSource "diffuse" "bool twosided" true Material "diffuse")" + kWall);
  expect_near(values.at("denoisingalbedo"), Rgb(1));
  EXPECT_NEAR(values.at("denoisingZ").r, 5, 1e-4);
}

TEST(ClearSight, PartsWhereFramesDo) {
  const std::string pane_that_goes = R"(DynamicBegin "pane"
Keyframe 1 Translate 0 0 0 Keyframe 2 Translate 100 0 0 KeyframeEnd
)" + pane(R"("conductor" "rgb reflectance" [.5 1 .25] "float roughness" 0)") +
                                     "\nDynamicEnd\n";
  expect_near(seen(pane_that_goes + kWall, 0).at("denoisingalbedo"), {.5f, 1, .25f});
  expect_near(seen(pane_that_goes + kWall, 1).at("denoisingalbedo"), {.2f, .4f, .6f});
}

}  // namespace clear_sight_test
}  // namespace dspm
