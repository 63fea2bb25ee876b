// Vertex connection and merging: every combination of its ways converges to what path tracing finds, and to nothing
// else where path tracing cannot go; frames of a joint render are those of renders of their own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/scenes.h"
#include "tests/integrators/box_scene.h"
#include "tests/integrators/random_scene.h"
#include "tests/support/seeds.h"

namespace dspm::test {
namespace vcm_test {

struct Case {
  const char* name;
  const char* contents;  // of the box
  bool lamp = true;      // the box's
  const char* camera = R"("perspective" "float fov" 26)";
  const char* filter = "\"box\"";
};

constexpr Case kCases[] = {
    {"Diffuse", R"(
Material "diffuse" "rgb reflectance" [.5 .5 .8]
Translate 0 -0.6 0.2
Shape "sphere" "float radius" 0.4)"},
    {"Materials", R"(
AttributeBegin
  Material "conductor" "float roughness" 0.05
  Translate -0.5 -0.6 0.3
  Shape "sphere" "float radius" 0.35
AttributeEnd
AttributeBegin
  Material "coateddiffuse" "rgb reflectance" [.6 .4 .2]
  Translate 0.45 -0.65 0.3
  Shape "sphere" "float radius" 0.3
AttributeEnd
AttributeBegin
  Material "coateddiffuse" "rgb reflectance" [.2 .4 .6] "float roughness" 0.1
  Translate 0 -0.7 -0.4
  Shape "sphere" "float radius" 0.25
AttributeEnd
Material "dielectric" "float roughness" 0.15
Translate 0 0.1 0.3
Shape "sphere" "float radius" 0.3)"},
    {"GlassAndMirror", R"(
AttributeBegin
  Material "conductor"
  Translate -0.4 -0.5 0.4
  Shape "sphere" "float radius" 0.4
AttributeEnd
AttributeBegin
  Material "thindielectric"
  Translate 0 0.4 0 Rotate 90 1 0 0
  Shape "disk" "float radius" 0.5
AttributeEnd
Material "dielectric"
Translate 0.4 -0.5 0
Shape "sphere" "float radius" 0.4)"},
    {"SmoothNormals", R"(
LightSource "spot" "rgb I" [9 9 9] "point3 from" [0.9 0.2 0.2] "point3 to" [0 0.2 0.2] "float coneangle" 18
Material "diffuse" "rgb reflectance" [.9 .9 .9]
Translate 0 0.2 0.2
Shape "trianglemesh" "integer indices" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]
  "point3 P" [.5 0 0 -.5 0 0 0 .5 0 0 -.5 0 0 0 .5 0 0 -.5] "normal N" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1])",
     false},
    {"PointAndSpot", R"(
LightSource "point" "rgb I" [1 1 2] "point3 from" [-0.5 0.4 0.3]
LightSource "spot" "rgb I" [4 3 3] "point3 from" [0.5 0.6 -0.5] "point3 to" [0 -1 0] "float coneangle" 35)",
     false, R"("perspective" "float fov" 26)", R"("gaussian")"},
    {"SunAndSky", R"(
LightSource "distant" "rgb L" [2 2 1] "point3 from" [0.4 0.5 -1] "point3 to" [0 0 0]
LightSource "infinite" "rgb L" [1 1 2])",
     false, R"("orthographic" "float screenwindow" [-1.2 1.2 -1.2 1.2])"},
    {"GlowingBallAndMesh", R"(
Material "diffuse" "rgb reflectance" [.2 .2 .2]
AreaLightSource "diffuse" "rgb L" [4 4 4]
AttributeBegin
  Translate -0.4 0.2 0.2
  Shape "sphere" "float radius" 0.15
AttributeEnd
AreaLightSource "diffuse" "rgb L" [3 2 4] "bool twosided" true
Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0.3 -0.2 0 0.7 -0.1 0.3 0.4 0.4 0.2])",
     false, R"("perspective" "float fov" 38 "float lensradius" 0.1 "float focaldistance" 3)",
     R"("triangle" "float xradius" 1.5)"},
    {"ManyLights", R"(
LightSource "point" "rgb I" [.1 .1 .2] "point3 from" [-0.8 0.4 0.3]
LightSource "point" "rgb I" [.2 .1 .2] "point3 from" [-0.6 0.4 0.3]
LightSource "point" "rgb I" [.3 .1 .2] "point3 from" [-0.4 0.4 0.3]
LightSource "point" "rgb I" [.1 .4 .2] "point3 from" [-0.2 0.4 0.3]
LightSource "point" "rgb I" [.1 .1 .5] "point3 from" [0 0.4 0.3]
LightSource "infinite" "rgb L" [.3 .2 .1]
LightSource "spot" "rgb I" [1 .1 .2] "point3 from" [0.2 0.4 0.3] "point3 to" [0 -1 0]
LightSource "distant" "rgb L" [.2 .3 .2] "point3 from" [.2 1 -1] "point3 to" [0 0 0]
LightSource "point" "rgb I" [.1 .8 .2] "point3 from" [0.4 0.4 0.3])"},
};

std::string scene_of(const Case& c, const std::string& integrator) {
  std::string text =
      box(fmt::format("PixelFilter {}\nIntegrator {} \"integer maxdepth\" 6\n", c.filter, integrator), c.contents, 32);
  replace(text, "0 0 0  0 1 0", "0 -0.3 0  0 1 0");
  replace(text, R"("perspective" "float fov" 38)", c.camera);
  if (!c.lamp) remove_lamp(text);
  return text;
}

/// Without merging, nothing but noise may remain.
struct Way {
  const char* parameters;
  double bias = 0;
};
constexpr Way kWays[] = {
    {R"("bool connect" false "bool merge" false "bool lighttracing" false)"},
    {R"("bool connect" false "bool merge" false)"},
    {R"("bool connect" true "bool merge" false "bool lighttracing" false)"},
    {R"("bool connect" true "bool merge" false)"},
    {R"("bool connect" false "bool merge" true "bool lighttracing" false "float radius" 0.02)", 0.01},
    {R"("bool connect" false "bool merge" true "float radius" 0.02)", 0.01},
    {R"("bool connect" true "bool merge" true "bool lighttracing" false "float radius" 0.02)", 0.01},
    {R"("bool connect" true "bool merge" true "float radius" 0.02)", 0.01},
};
constexpr double kLevel = 0.01 / static_cast<double>(std::size(kCases) * std::size(kWays));  // 1% for all together
constexpr int kQuarters = 2;

class EveryWay : public testing::TestWithParam<Case> {};

TEST_P(EveryWay, AgreesWithPathTracing) {
  const Tiles path = rendered(scene_of(GetParam(), R"("path")"), 8, seeds(9), kQuarters);
  for (const Way& way : kWays) {
    const std::string vcm = fmt::format(R"("vcm" "integer photons" 700 {})", way.parameters);
    const Verdict verdict =
        agreement(rendered(scene_of(GetParam(), vcm), 4, seeds(9), kQuarters), path, {kLevel, way.bias});
    EXPECT_TRUE(verdict.passed) << way.parameters << ": " << verdict.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryWay, testing::ValuesIn(kCases),
                         [](const auto& scene) { return std::string(scene.param.name); });

// A narrow spot on the ceiling, out of view, from where its light comes: no camera path finds it easily, so that the ways
// named here have nearly all of the weight.
TEST(VcmWays, AgreeWithPathTracingWhereTheyAreAlmostAlone) {
  const Case c{"", R"(
LightSource "spot" "rgb I" [200 150 100] "point3 from" [0.2 0.5 0] "point3 to" [0 1 0] "float coneangle" 30)",
               false};
  constexpr Way kAlone[] = {
      {R"("integer photons" 700 "bool connect" true "bool merge" false "bool lighttracing" false)"},
      {R"("integer photons" 30000 "bool connect" false "bool merge" false)"},
      {R"("integer photons" 30000 "bool connect" false "bool lighttracing" false "float radius" 0.02)", 0.003},
  };
  const Tiles path = rendered(scene_of(c, R"("path")"), 128, seeds(9), kQuarters);
  for (const Way& way : kAlone) {
    const std::string vcm = fmt::format(R"("vcm" {})", way.parameters);
    const Verdict verdict = agreement(rendered(scene_of(c, vcm), 8, seeds(9), kQuarters), path, {0.003, way.bias});
    EXPECT_TRUE(verdict.passed) << way.parameters << ": " << verdict.message;
  }
}

// A spot by way of glass, seen straight and through the glass: no path of the camera hits it, and no shadow ray finds it.
TEST(VcmWays, AgreeWithPhotonsWherePathTracingCannotGo) {
  const Case c{"", R"(
LightSource "spot" "rgb I" [20 18 15] "point3 from" [0.4 0.9 -0.3] "point3 to" [0 -0.5 0.2] "float coneangle" 25
Material "dielectric"
Translate 0 -0.5 0.2
Shape "sphere" "float radius" 0.35)",
               false};
  const Tiles photons =
      rendered(scene_of(c, R"("dsppm" "integer photons" 20000 "float radius" 0.02)"), 6, seeds(9), kQuarters);
  const Tiles vcm =
      rendered(scene_of(c, R"("vcm" "integer photons" 20000 "float radius" 0.02)"), 6, seeds(9), kQuarters);
  const Verdict verdict = agreement(vcm, photons, {0.003, 0.01});
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

TEST(VcmFrames, EachIsWhatItIsAlone) {
  for (const char* ways : {"", R"("bool merge" false)", R"("bool connect" false)", R"("bool sharepaths" false)"})
    for (unsigned seed = 0; seed < 6; ++seed) {
      const std::string text =
          RandomScene(seed, 5).text(fmt::format("Integrator \"vcm\" \"integer photons\" 600 {}", ways));
      SCOPED_TRACE(text);
      const Verdict verdict = check_joint(text, 2);
      EXPECT_TRUE(verdict.passed) << verdict.message;
    }
}

}  // namespace vcm_test
}  // namespace dspm::test
