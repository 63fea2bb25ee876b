// A closed, evenly glowing, evenly reflecting sphere has radiance 1 / (1 - albedo) everywhere: see furnace() for why.
// And a sheet under an even sky shows its albedo.
#include "dspm/testing/furnace.h"

#include <gtest/gtest.h>

#include "dspm/testing/agreement.h"
#include "dspm/testing/scattering.h"
#include "dspm/testing/scenes.h"

namespace dspm::test {
namespace furnace_test {

struct Case {
  const char* integrator;
  int iterations;
};

class FurnaceOf : public testing::TestWithParam<Case> {};

TEST_P(FurnaceOf, HasTheAnalyticRadiance) {
  const Verdict verdict = check_furnace(GetParam().integrator, GetParam().iterations, {0.01, 0.002});
  EXPECT_TRUE(verdict.passed) << GetParam().integrator << ": " << verdict.message;
}

/// Its own radiance 1, and once reflected, 0.8.
TEST(Furnace, DirectLightIsOneReflection) {
  const std::string scene = furnace(R"("path" "integer maxdepth" 40 "bool indirect" false)", 0.8f);
  const Verdict verdict = agreement(rendered(scene, 8), Rgb(1.8f));
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

// maxdepth 40: what is left out is 0.8^40 = 0.013%.
INSTANTIATE_TEST_SUITE_P(
    Integrators, FurnaceOf,
    testing::Values(
        Case{R"("path" "integer maxdepth" 40)", 8},
        Case{R"("sppm" "integer maxdepth" 40 "integer photons" 5000 "string estimator" "hj09")", 2},
        Case{R"("sppm" "integer maxdepth" 40 "integer photons" 5000)", 2},
        Case{R"("dsppm" "integer maxdepth" 40 "integer photons" 5000 "string estimator" "hj09")", 2},
        Case{R"("dsppm" "integer maxdepth" 40 "integer photons" 5000 "string estimator" "kz11")", 2},
        Case{R"("dsppm" "integer maxdepth" 40 "integer photons" 5000 "string direct" "photons")", 2},
        Case{R"("dsppm" "integer maxdepth" 40 "integer photons" 5000 "string direct" "sampled")", 3},
        Case{R"("photonmap" "integer maxdepth" 40 "integer photons" 12000 "float radius" 0.2
"integer causticphotons" 10000)",
             2},
        Case{R"("photonmap" "integer maxdepth" 40 "integer photons" 12000 "float radius" 0.2 "integer nearest" 5
"integer causticphotons" 10000)",
             2},
        Case{R"("photonmap" "integer maxdepth" 40 "integer photons" 20000 "integer finalgather" 1
"integer causticphotons" 20000)",
             2},
        Case{R"("photonmap" "integer maxdepth" 40 "integer photons" 20000 "integer finalgather" 4
"integer causticphotons" 20000)",
             1},
        Case{R"("vcm" "integer maxdepth" 40 "integer photons" 5000)", 2},
        Case{R"("vcm" "integer maxdepth" 40 "bool merge" false)", 4}));

class OpenFurnace : public testing::TestWithParam<const char*> {};

TEST_P(OpenFurnace, ShowsTheAlbedo) {
  for (const char* integrator : {R"("path")", R"("dsppm" "integer photons" 5000)", R"("vcm" "integer photons" 2000)"}) {
    const Verdict verdict = check_open_furnace(GetParam(), integrator, 8, {0.01, 0.01});
    EXPECT_TRUE(verdict.passed) << integrator << " " << GetParam() << ": " << verdict.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, OpenFurnace,
                         testing::Values(R"("diffuse" "rgb reflectance" [.2 .5 .8])",
                                         R"("conductor" "float roughness" 0.2)", R"("conductor")",
                                         R"("coateddiffuse" "rgb reflectance" [.6 .4 .2] "float roughness" 0.1)",
                                         R"("dielectric" "float roughness" 0.15)", R"("thindielectric")"));

/// A ball of the material that fills the picture, under a sky of radiance 1.
std::string white_ball(const std::string& integrator, const std::string& material) {
  return "Integrator " + integrator + R"(
LookAt 0 0 -4  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-.69 .69 -.69 .69]
PixelFilter "box"
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Material )" +
         material + "\nShape \"sphere\"\n";
}

// What absorbs nothing gives back all light, however often light meets it: facets lose nothing, and no depth cuts it off.
TEST(Furnace, WhiteBallsAreNotSeen) {
  for (const char* roughness : {"0.1", "0.3", "0.6", "1"})
    for (const std::string material : {R"("dielectric")", R"("conductor" "rgb reflectance" [1 1 1])",
                                       R"("coateddiffuse" "rgb reflectance" [1 1 1])"}) {
      const std::string rough = material + " \"float roughness\" " + roughness;
      const Verdict verdict = agreement(rendered(white_ball(R"("path" "integer maxdepth" 100)", rough), 8), Rgb(1),
                                        {0.01, material == "\"dielectric\"" ? 0.015 : 0.005});
      EXPECT_TRUE(verdict.passed) << rough << ": " << verdict.message;
    }
}

}  // namespace furnace_test
}  // namespace dspm::test
