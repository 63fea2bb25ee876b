// Curves in every integrator: white hair under an even sky cannot be seen, and all find what path tracing finds, though
// none gathers on curves.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/scenes.h"
#include "tests/shapes/random.h"

namespace dspm::test {
namespace curves_test {

/// Strands from the floor of a box up, bent at random.
std::string tuft(int strands, const char* type, float width) {
  Random random(3);
  std::string text;
  for (int i = 0; i < strands; ++i) {
    Vec3 p = Vec3{0, -1, 0.2f} + 0.5f * Vec3{random.uniform(-1, 1), 0, random.uniform(-1, 1)}, d{0, 0.5f, 0};
    text += fmt::format("Shape \"curve\" \"string type\" \"{}\" \"float width0\" {} \"float width1\" {} \"point3 P\" [",
                        type, width, 0.6f * width);
    for (int k = 0; k < 4; ++k, p = p + d, d = d + random.in_cube(0.2f))
      text += fmt::format("{} {} {} ", p.x, p.y, p.z);
    text += "]\n";
  }
  return text;
}

struct Case {
  const char* name;
  const char* look;  // material, and type of curve
  const char* type;
};
constexpr Case kCases[] = {
    {"Hair", R"(Material "hair" "rgb sigma_a" [.1 .3 .6])", "cylinder"},
    {"MatteGrass", R"(Material "diffuse" "rgb reflectance" [.3 .6 .2])", "flat"},
};

class CurvesIn : public testing::TestWithParam<Case> {};

TEST_P(CurvesIn, AllIntegratorsFindTheSame) {
  const auto scene = [&](const char* integrator) {
    return box(std::string("Integrator ") + integrator, GetParam().look + ("\n" + tuft(40, GetParam().type, 0.06f)),
               16);
  };
  const Tiles path = rendered(scene(R"("path" "integer maxdepth" 24)"), 96, 16, 2);
  for (const char* integrator : {R"("dsppm" "integer maxdepth" 24 "integer photons" 4000 "float radius" 0.1)",
                                 R"("vcm" "integer maxdepth" 24)"}) {
    const Verdict verdict = agreement(rendered(scene(integrator), 24, 16, 2), path, {0.01, 0.01});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Looks, CurvesIn, testing::ValuesIn(kCases), [](const auto& each) { return each.param.name; });

// What is scattered by white hair comes from the sky in the end, wherever it went: the picture is 1.
TEST(CurvesIn, AFurnaceWhiteHairIsInvisible) {
  for (const char* integrator :
       {R"("path" "integer maxdepth" 100)", R"("dsppm" "integer maxdepth" 100 "integer photons" 100)",
        R"("vcm" "integer maxdepth" 100 "integer photons" 100)"}) {
    const std::string scene = std::string("Integrator ") + integrator + R"(
PixelFilter "box"
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 22
Film "rgb" "integer xresolution" 12 "integer yresolution" 12
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Material "hair" "rgb sigma_a" [0 0 0]
)" + tuft(60, "cylinder", 0.08f);
    const Verdict verdict = agreement(rendered(scene, 8), Rgb(1), {0.01, 0.002});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

// Hair that turns with its block, and hair whose points are keyed.
TEST(CurvesIn, FramesTogetherAreFramesAlone) {
  const std::string scene = box(R"(Frames 3
Integrator "dsppm" "integer photons" 2000)",
                                R"(DynamicBegin "head"
Material "hair"
Keyframe 1 Rotate 0 0 1 0 Keyframe 3 Rotate 30 0 1 0 KeyframeEnd
)" + tuft(10, "flat", 0.05f) + R"(DynamicEnd
DynamicBegin "blade"
Shape "curve" "float width" 0.1 "point3 P@1" [0 -1 0 0 -.6 0 0 0 0 0 .4 0] "point3 P@3" [0 -1 0 0 -.6 0 .5 0 0 .6 .2 0]
DynamicEnd)",
                                12);
  const Verdict verdict = check_joint(scene, 2);
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

}  // namespace curves_test
}  // namespace dspm::test
