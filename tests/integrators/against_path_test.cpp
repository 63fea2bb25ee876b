// Every integrator against path tracing: what noise does not explain must be below a stated bias of the photons' blur.
// Quarters of the picture and the whole are compared, over many seeds: few figures, but sharp ones. For blocks, see
// own_references_test.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/testing/agreement.h"
#include "dspm/testing/scenes.h"
#include "tests/integrators/box_scene.h"
#include "tests/support/seeds.h"

namespace dspm::test {
namespace against_path_test {

struct Case {
  const char* name;
  const char* contents;  // of the box
  bool lamp = true;      // the box's
  const char* lens = "";
};

constexpr double kBias = 0.01;

constexpr Case kCases[] = {
    {"Diffuse", R"(
Material "diffuse" "rgb reflectance" [.5 .5 .8]
Translate 0 -0.6 0.2
Shape "sphere" "float radius" 0.4)"},
    {"RoughMetal", R"(
Material "conductor" "float roughness" 0.35
Translate 0 -0.4 0.2
Shape "sphere" "float radius" 0.5)"},
    {"Glass", R"(
Material "dielectric" "float eta" 1.5
Translate 0 -0.4 0.2
Shape "sphere" "float radius" 0.45)"},
    {"Coat", R"(
Material "coateddiffuse" "rgb reflectance" [.6 .4 .2] "float roughness" 0.3
Translate 0 -0.4 0.2
Shape "sphere" "float radius" 0.5)"},
    // All light comes by way of the bent normals.
    {"SmoothedAlone", R"(
LightSource "spot" "rgb I" [9 9 9] "point3 from" [0.9 0.2 0.2] "point3 to" [0 0.2 0.2] "float coneangle" 18
Material "diffuse" "rgb reflectance" [.9 .9 .9]
Translate 0 0.2 0.2
Shape "trianglemesh" "integer indices" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]
  "point3 P" [.5 0 0 -.5 0 0 0 .5 0 0 -.5 0 0 0 .5 0 0 -.5] "normal N" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1])",
     false},
    // Both of its lobes gather: light that comes through the surface counts as well.
    {"RoughGlass", R"(
Material "dielectric" "float eta" 1.5 "float roughness" 0.15
Translate 0 -0.4 0.2
Shape "sphere" "float radius" 0.5)"},
    // Smoother than what gathers: its lobe is followed, and no ray finds the point light.
    {"GlossyMetalAndPoint", R"(
LightSource "point" "rgb I" [2 2 2] "point3 from" [0.3 0.5 -0.9]
Material "conductor" "float roughness" 0.03
Translate 0 -0.4 0.2
Shape "sphere" "float radius" 0.5)"},
    {"PointAndSpot", R"(
LightSource "point" "rgb I" [1 1 2] "point3 from" [-0.5 0.4 0.3]
LightSource "spot" "rgb I" [4 3 3] "point3 from" [0.5 0.6 -0.5] "point3 to" [0 -1 0] "float coneangle" 35)",
     false},
    {"SunAndSky", R"(
LightSource "distant" "rgb L" [2 2 1] "point3 from" [0.4 0.5 -1] "point3 to" [0 0 0]
LightSource "infinite" "rgb L" [1 1 2])",
     false},
    {"GlowingBallAndMesh", R"(
Material "diffuse" "rgb reflectance" [0 0 0]
AreaLightSource "diffuse" "rgb L" [4 4 4]
AttributeBegin
  Translate -0.4 0.2 0.2
  Shape "sphere" "float radius" 0.15
AttributeEnd
AreaLightSource "diffuse" "rgb L" [3 2 4] "bool twosided" true
Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0.3 -0.2 0 0.7 -0.1 0.3 0.4 0.4 0.2])",
     false},
    {"Textures", R"(
Texture "checks" "spectrum" "checkerboard" "float uscale" 8 "float vscale" 4 "rgb tex1" [.9 .3 .2] "rgb tex2" [.2 .4 .9]
Texture "faded" "spectrum" "scale" "texture tex" "checks" "float scale" .5
Texture "spots" "float" "checkerboard" "float uscale" 4 "float vscale" 4
Texture "worn" "spectrum" "mix" "texture tex1" "checks" "texture tex2" "faded" "texture amount" "spots"
Material "diffuse" "texture reflectance" "worn"
Translate 0 -0.4 0.2
Shape "sphere" "float radius" 0.5)"},
    {"ThinLens", R"(
Material "diffuse" "rgb reflectance" [.5 .5 .8]
Translate 0 -0.6 -0.5
Shape "sphere" "float radius" 0.4)",
     true, R"( "float lensradius" 0.2 "float focaldistance" 3)"},
};

/// The lamp is left out of view: it is so bright that the pixels at its rim would make most of the noise.
std::string scene_of(const Case& c, const std::string& integrator) {
  std::string text = box("Integrator " + integrator + " \"integer maxdepth\" 16\n", c.contents, 48);
  replace(text, "0 0 0  0 1 0", "0 -0.3 0  0 1 0");
  replace(text, R"("float fov" 38)", R"("float fov" 26)" + std::string(c.lens));
  if (!c.lamp) remove_lamp(text);
  return text;
}

struct Way {
  const char* integrator;
  int iterations;
};
constexpr Way kWays[] = {
    {R"("sppm" "string estimator" "hj09" "integer photons" 12000 "float radius" 0.03)", 2},
    {R"("dsppm" "string estimator" "kz11" "integer photons" 12000 "float radius" 0.03)", 2},
    {R"("dsppm" "string direct" "photons" "integer photons" 12000 "float radius" 0.03)", 2},
    {R"("dsppm" "string estimator" "hj09" "string direct" "sampled" "integer photons" 12000 "float radius" 0.03)", 2},
    {R"("photonmap" "integer photons" 18000 "integer causticphotons" 12000 "float radius" 0.06 "float causticradius" 0.03)",
     1},
    {R"("photonmap" "integer finalgather" 4 "integer photons" 18000 "integer causticphotons" 12000 "float radius" 0.06
  "float causticradius" 0.03)",
     1}};
constexpr double kLevel = 0.01 / static_cast<double>(std::size(kCases) * std::size(kWays));  // 1% for all together
constexpr int kQuarters = 2;

class AgainstPath : public testing::TestWithParam<Case> {};

TEST_P(AgainstPath, AllIntegratorsAgree) {
  const Tiles path = rendered(scene_of(GetParam(), R"("path")"), 8, seeds(8), kQuarters);
  for (const Way& way : kWays) {
    const Tiles found = rendered(scene_of(GetParam(), way.integrator), way.iterations, seeds(8), kQuarters);
    const Verdict verdict = agreement(found, path, {kLevel, kBias});
    EXPECT_TRUE(verdict.passed) << way.integrator << ": " << verdict.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, AgainstPath, testing::ValuesIn(kCases),
                         [](const auto& scene) { return std::string(scene.param.name); });

}  // namespace against_path_test
}  // namespace dspm::test
