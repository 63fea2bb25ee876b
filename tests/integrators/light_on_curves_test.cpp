// What a light without extent sends through a pane onto curves. Nothing but photons brings it there, and a curve has no area
// on which to count them: they are counted on the strip that it shows to the light. Path tracing without the pane tells
// what is right: the light's rays meet the pane straight on, and it passes (1 - R) / (1 + R), R = 0.04.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/session/job/choices.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/compare.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/test_scene.h"
#include "tests/support/seeds.h"

namespace dspm::test {
namespace light_on_curves_test {

constexpr double kPassed = (1 - .04) / (1 + .04);

/// Four curves, one in each column of the picture: of one segment, and of three.
std::string curves(const char* type, double width) {
  std::string text;
  const std::string look = fmt::format("\"string type\" \"{}\" \"float width\" {}", type, width);
  const std::string normals = std::string(type) == "ribbon" ? " \"normal N\" [0 0 1  .6 0 .8]" : "";
  for (int i = 0; i < 4; ++i) {
    const double x = 0.5 * i - 0.75;
    text += i % 2 == 0
                ? fmt::format("Shape \"curve\" {}{} \"point3 P\" [{} -1.2 0  {} -.4 .2  {} .4 -.1  {} 1.2 0]\n", look,
                              normals, x, x + 0.1, x - 0.1, x)
                : fmt::format(
                      "Shape \"curve\" {}{} \"string basis\" \"bspline\" \"point3 P\" [{} -2 .1  {} -1.2 0  {} -.4 .1  "
                      "{} .4 0  {} 1.2 .1  {} 2 0]\n",
                      look, normals.empty() ? "" : " \"normal N\" [0 0 1  .3 0 .9  0 0 1  0 .1 1]", x, x + 0.05, x,
                      x + 0.05, x, x + 0.05);
  }
  return text;
}

struct Look {
  const char* name;
  const char* material;
  const char* type;
  double width;
  const char* light = R"("distant" "point3 from" [.48 .36 .8] "point3 to" [0 0 0])";
};

constexpr const char* kBehind = R"("distant" "point3 from" [.48 .36 -.8] "point3 to" [0 0 0])";
constexpr const char* kMatte = R"("diffuse" "rgb reflectance" [.3 .6 .2])";
constexpr const char* kLeaf = R"("diffusetransmission" "rgb reflectance" [.3 .6 .2] "rgb transmittance" [.2 .3 .4])";
constexpr const char* kHair = R"("hair" "rgb sigma_a" [.1 .3 .6])";

constexpr Look kLooks[] = {
    {"MatteFlat", kMatte, "flat", 0.3},
    {"MatteCylinder", kMatte, "cylinder", 0.1},
    {"MatteRibbon", kMatte, "ribbon", 0.3},
    {"LeafRibbonFromBehind", kLeaf, "ribbon", 0.3, kBehind},
    {"Hair", kHair, "cylinder", 0.1},
    {"HairFromBehind", kHair, "cylinder", 0.1, kBehind},
    {"GlossyFlat", R"("conductor" "float roughness" .4)", "flat", 0.1},
};

/// `pane`: at 3 from the origin, across the light, whose rays come from there.
std::string scene(const Look& look, const std::string& integrator, bool pane, const char* frames = "",
                  const std::string& more = "") {
  const double irradiance = pane ? 1 : kPassed;
  std::string light = look.light;
  light.insert(light.find(' '), fmt::format(" \"rgb L\" [{0} {0} {0}]", irradiance));
  std::string text = fmt::format(R"(
{}
Integrator {}
LookAt 0 0 2  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-1 1 -1 1]
PixelFilter "box"
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource {}
{}
Material {}
{})",
                                 frames, integrator, light, more, look.material, curves(look.type, look.width));
  if (!pane) return text;
  const bool behind = look.light == kBehind;
  return text + fmt::format(
                    "Material \"thindielectric\"\nTranslate 1.44 1.08 {}\n"
                    "Rotate {} -.6 .8 0\nShape \"disk\" \"float radius\" 2.2\n",
                    behind ? -2.4 : 2.4, behind ? -36.8698976 : 36.8698976);
}

class LightOnCurves : public testing::TestWithParam<Look> {};

TEST_P(LightOnCurves, PassesAPane) {
  const Look& look = GetParam();
  const int times = seeds(8);
  const Tiles path = rendered(scene(look, R"("path" "integer maxdepth" 1)", false), 128, times);
  const std::string settings = "\"integer photons\" 4000 \"float radius\" .1 \"integer maxdepth\" 2";
  std::vector<std::string> integrators = {"\"dsppm\" " + settings, "\"vcm\" " + settings};
  if (std::string(look.name) == kLooks[0].name)
    integrators.insert(integrators.end(),
                       {"\"dsppm\" \"string estimator\" \"hj09\" " + settings, "\"sppm\" " + settings,
                        R"("photonmap" "integer photons" 100 "integer causticphotons" 40000 "float causticradius" .05
                           "integer maxdepth" 2)"});
  for (const std::string& integrator : integrators) {
    const Verdict verdict = agreement(rendered(scene(look, integrator, true), 8, times), path, {0.01 / 17, 0.015});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Looks, LightOnCurves, testing::ValuesIn(kLooks),
                         [](const auto& each) { return each.param.name; });

// A sheet cuts the light off in the middle of a wide curve. It is seen from where the light comes: from elsewhere, paths
// displace the edge, since their shadow rays start in front of the curve.
TEST(LightOnCurves, EndsAtAShadowsEdge) {
  const Look wide{"", kMatte, "flat", 0.5, R"("distant" "point3 from" [.48 .36 .8] "point3 to" [0 0 0])"};
  const std::string sheet = R"(
AttributeBegin
  Material "diffuse" "rgb reflectance" [0 0 0]
  Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-.2 -3 .8  .3 -3 .8  .3 3 .8  -.2 3 .8]
AttributeEnd)";
  const int times = seeds(8);
  const auto picture = [&](const char* integrator, bool pane, int iterations) {
    std::string text = scene(wide, integrator, pane, "", sheet);
    const std::string from = "LookAt 0 0 2";
    return rendered(text.replace(text.find(from), from.size(), "LookAt .384 .288 .64"), iterations, times, 2);
  };
  const Tiles path = picture(R"("path" "integer maxdepth" 1)", false, 256);
  const Tiles photons = picture(R"("dsppm" "integer photons" 8000 "float radius" .04 "integer maxdepth" 2)", true, 16);
  const Verdict verdict = agreement(photons, path, {0.01, 0.02});
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

// What shadow rays and paths find by themselves is not brought once more: a light's own rays, and those that curves and a
// wall throw on one another.
TEST(LightOnCurves, CountsOnce) {
  const Look lit = kLooks[1];
  const std::string lamp = R"(
LightSource "point" "rgb I" [1 1 1] "point3 from" [0 0 1.5]
Material "conductor" "float roughness" .5
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-3 -3 -.5  3 -3 -.5  3 3 -.5  -3 3 -.5])";
  const int times = seeds(8);
  const Tiles path = rendered(scene(lit, R"("path" "integer maxdepth" 12)", false, "", lamp), 256, times);
  for (const char* integrator : {R"("dsppm" "integer photons" 1000 "integer maxdepth" 12)",
                                 R"("vcm" "integer photons" 256 "integer maxdepth" 12)"}) {
    const Verdict verdict =
        agreement(rendered(scene(lit, integrator, false, "", lamp), 16, times), path, {0.01 / 2, 0.01});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

// Hair that turns under a pane, with a light that dims.
TEST(LightOnCurves, FramesTogetherAreFramesAlone) {
  const std::string moving = R"(
DynamicBegin "lock"
  Material "hair"
  Keyframe 1 Rotate 0 0 1 0 Keyframe 3 Rotate 20 0 1 0 KeyframeEnd
  Shape "curve" "float width" .05 "point3 P" [-.5 -.5 .3  -.2 .4 .3  .2 .6 .3  .5 .8 .3]
DynamicEnd
LightSource "point" "rgb I@1" [9 9 9] "rgb I@3" [3 2 1] "point3 from" [2 1.5 6])";
  std::vector<std::string> integrators = {R"("dsppm" "integer photons" 2000)",
                                          R"("dsppm" "integer photons" 2000 "string estimator" "hj09")",
                                          R"("vcm" "integer photons" 2000)"};
  // Its photons are traced once and gathered in every iteration.
  for (int seed = 0; seed < 4; ++seed)
    integrators.push_back(
        fmt::format(R"("photonmap" "integer seed" {} "integer photons" 100 "integer causticphotons" 2000)", seed));
  for (const std::string& integrator : integrators) {
    const Verdict verdict = check_joint(scene(kLooks[4], integrator, true, "Frames 3", moving), 2);
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

// The groups' parts add up to the picture.
TEST(LightOnCurves, IsOfItsLightsGroup) {
  Choices choices;
  choices.outputs = {"lights"};
  for (const char* integrator :
       {R"("dsppm" "integer photons" 2000 "integer maxdepth" 2)",
        R"("vcm" "integer photons" 2000 "integer maxdepth" 2)",
        R"("photonmap" "integer photons" 100 "integer causticphotons" 2000 "integer maxdepth" 2)"}) {
    std::string text = scene(kLooks[0], integrator, true);
    text.insert(text.find("\"distant\"") + 9, " \"string group\" \"key\"");
    TestScene test(text + "\nLightSource \"point\" \"rgb I\" [9 9 9] \"point3 from\" [0 0 1]\n", choices);
    const auto one = test.scene({FileFrame(0)});
    const auto made = test.integrator(*one);
    for (int i = 0; i < 4; ++i) made->iterate({i, *one});
    const double whole = static_cast<double>(mean(made->estimate(0)).g),
                 key = static_cast<double>(mean(made->estimate(0, "light_key")).g),
                 other = static_cast<double>(mean(made->estimate(0, "light_other")).g);
    EXPECT_NEAR((key + other) / whole, 1, 1e-4) << integrator;
    EXPECT_GT(key, 0.02 * whole) << integrator;
  }
}

}  // namespace light_on_curves_test
}  // namespace dspm::test
