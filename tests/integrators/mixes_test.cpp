// Mixes as integrators see them: a blend from afar, the same for photons and camera paths, and shared between frames.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/scenes.h"

namespace dspm::test {
namespace mixes_test {

// Under a sky of radiance 1, a matte floor is as bright as its reflectance.
TEST(Mixes, OfTwoMatteFloorsAreTheirMean) {
  for (const char* integrator :
       {R"("path")", R"("dsppm" "integer photons" 20000 "float radius" .3)",
        R"("dsppm" "integer photons" 20000 "float radius" .3 "string estimator" "hj09" "string direct" "photons")",
        R"("vcm" "integer photons" 2000)"}) {
    const std::string floor =
        open_furnace(integrator, R"("mix" "string materials" ["light" "dark"] "float amount" .25)") +
        R"(MakeNamedMaterial "light" "string type" "diffuse" "rgb reflectance" [.8 .4 .2]
                                 MakeNamedMaterial "dark" "string type" "diffuse" "rgb reflectance" [.4 .4 .6])";
    const Verdict verdict = agreement(rendered(floor, 8), Rgb(0.7f, 0.4f, 0.3f), {0.01 / 4, 0.002});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

std::string plated(const std::string& options) {
  return box(options, R"(
MakeNamedMaterial "metal" "string type" "conductor" "float roughness" .05
MakeNamedMaterial "paint" "string type" "diffuse" "rgb reflectance@1" [.8 .3 .2] "rgb reflectance@3" [.2 .3 .8]
Material "mix" "string materials" ["metal" "paint"] "float amount@1" .4 "float amount@3" .8
AttributeBegin Translate .1 -.5 0 Shape "sphere" "float radius" .5 AttributeEnd
)",
             16);
}

TEST(Mixes, AllIntegratorsFindTheSame) {
  const auto scene = [](const char* integrator) {
    return plated(fmt::format("Frames 3\nIntegrator {}\n", integrator));
  };
  const Tiles path = rendered(scene(R"("path" "integer maxdepth" 8)"), 64);
  for (const char* integrator : {R"("dsppm" "integer maxdepth" 8 "integer photons" 30000 "float radius" .06)",
                                 R"("vcm" "integer maxdepth" 8 "integer photons" 1000)"}) {
    const Verdict verdict = agreement(rendered(scene(integrator), 6), path, {0.01 / 2, 0.02});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

TEST(Mixes, FramesAreWhatTheyAreAlone) {
  for (const char* integrator : {R"("path")", R"("dsppm" "integer photons" 2000)", R"("sppm" "integer photons" 2000)",
                                 R"("vcm" "integer photons" 500)"}) {
    const Verdict verdict = check_joint(plated(fmt::format("Frames 3\nIntegrator {}\n", integrator)), 2);
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

}  // namespace mixes_test
}  // namespace dspm::test
