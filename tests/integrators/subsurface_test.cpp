// Bodies that scatter light inside: nothing is lost without absorption, a thick body returns what it is asked for, and
// all integrators agree about what shines through.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/scattering.h"
#include "dspm/testing/scenes.h"

namespace dspm::test {
namespace subsurface_test {

TEST(Subsurface, ItsSurfaceScattersAsItSamples) {
  for (const char* words :
       {R"("subsurface")", R"("subsurface" "float eta" 1 "float roughness" .3)",
        R"("subsurface" "rgb reflectance" [.9 .5 .1] "rgb mfp" [.2 .1 .1] "float roughness" .2 "float g" -.3)",
        R"("subsurface" "string name" "Skin1" "float eta" 2.4 "float uroughness" .05 "float vroughness" .4)",
        R"("subsurface" "float eta" .75 "float roughness" .2)"}) {
    const Verdict verdict = check_scattering(words);
    EXPECT_TRUE(verdict.passed) << words << ": " << verdict.message;
  }
}

/// A ball of radius 1 under a sky of radiance 1; the camera sees nothing else.
std::string ball(const std::string& integrator, const std::string& material) {
  return fmt::format(R"(
Integrator {}
LookAt 0 0 -5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-.6 .6 -.6 .6]
PixelFilter "box"
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Material {}
Shape "sphere"
)",
                     integrator, material);
}

// However often the surface throws light back, a walk through the body is one bounce in and one out.
TEST(Subsurface, WithoutAbsorptionABodyUnderAnEvenSkyIsNotSeen) {
  for (const char* words :
       {R"("subsurface" "rgb sigma_a" [0 0 0] "rgb sigma_s" [1 4 2])",
        R"("subsurface" "rgb sigma_a" [0 0 0] "rgb sigma_s" [3 3 3] "float g" .7 "float eta" 1.5 "float roughness" 0)",
        R"("subsurface" "rgb sigma_a" [0 0 0] "rgb sigma_s" [0 1 3] "float eta" 1)"}) {
    const Verdict verdict =
        agreement(rendered(ball(R"("path" "integer maxdepth" 3)", words), 32, 8), Rgb(1), {0.01 / 3, 0.002});
    EXPECT_TRUE(verdict.passed) << words << ": " << verdict.message;
  }
}

// Light that gets in comes out by the reflectance that the scene asks for; without an index, all light gets in. The
// formula behind it is good to 1.5% if collisions scatter alike in all directions, else to 5%. The ball is as thick as
// 100 to 200 flights.
TEST(Subsurface, AThickBodyReturnsItsReflectance) {
  for (const float g : {0.f, 0.5f}) {
    const std::string words = fmt::format(
        R"("subsurface" "rgb reflectance" [.9 .6 .2] "rgb mfp" [.01 .015 .02] "float eta" 1 "float g" {})", g);
    const Verdict verdict = agreement(rendered(ball(R"("path" "integer maxdepth" 3)", words), 48, 8),
                                      Rgb(0.9f, 0.6f, 0.2f), {0.01 / 2, g == 0 ? 0.015 : 0.05});
    EXPECT_TRUE(verdict.passed) << g << ": " << verdict.message;
  }
}

/// A small slab and a ball in the box, thin enough for light to shine through.
std::string bodies(const std::string& integrator) {
  return box("Integrator " + integrator, R"(
Material "subsurface" "rgb reflectance" [.9 .7 .4] "rgb mfp" [.2 .15 .1] "float eta" 1.3
AttributeBegin Translate -.3 -.5 .2 Shape "sphere" "float radius" 0.45 AttributeEnd
Material "subsurface" "rgb sigma_a" [.1 .5 .5] "rgb sigma_s" [4 3 2] "float g" .4 "float roughness" .1
AttributeBegin Translate .55 -.6 -.3 Shape "sphere" "float radius" 0.3 AttributeEnd
)",
             16);
}

TEST(Subsurface, AllIntegratorsFindTheSame) {
  const Tiles path = rendered(bodies(R"("path" "integer maxdepth" 12)"), 48);
  struct Case {
    const char* integrator;
    int iterations;
  };
  const Case cases[] = {
      {R"("dsppm" "integer maxdepth" 12 "integer photons" 30000 "float radius" .06)", 2},
      {R"("sppm" "integer maxdepth" 12 "integer photons" 30000 "float radius" .06 "string estimator" "hj09")", 2},
      {R"("vcm" "integer maxdepth" 12 "integer photons" 1000)", 16},
      {R"("vcm" "integer maxdepth" 12 "integer photons" 1000 "bool merge" false)", 16}};
  for (const Case& each : cases) {
    const Verdict verdict =
        agreement(rendered(bodies(each.integrator), each.iterations), path, {0.01 / std::size(cases), 0.02});
    EXPECT_TRUE(verdict.passed) << each.integrator << ": " << verdict.message;
  }
}

TEST(Subsurface, FramesShareAndEachIsWhatItIsAlone) {
  for (const char* integrator : {R"("dsppm" "integer photons" 2000)", R"("path")", R"("vcm" "integer photons" 500)"}) {
    const std::string scene = box(fmt::format("Frames 4\nIntegrator {}\n", integrator), R"(
Material "subsurface" "rgb reflectance@1" [.9 .7 .4] "rgb reflectance@4" [.3 .7 .9] "rgb mfp" [.2 .2 .2]
AttributeBegin Translate -.3 -.5 .2 Shape "sphere" "float radius" 0.45 AttributeEnd
DynamicBegin "ball"
  Keyframe 1 Translate .5 -.6 -.3 Keyframe 4 Translate .5 .2 -.3 KeyframeEnd
  Material "subsurface" "string name" "Skin1" "float scale" 3
  Shape "sphere" "float radius" 0.3
DynamicEnd
)",
                                  12);
    for (const auto& check : {check_joint, check_threads, check_resume}) {
      const Verdict verdict = check(scene, 2);
      EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
    }
  }
}

}  // namespace subsurface_test
}  // namespace dspm::test
