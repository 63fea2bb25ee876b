// photonmap's final gather, where the answer is known: rays from a hit point bring the light of all other surfaces, and
// nothing else.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace final_gather_test {

constexpr int kTests = 12;  // all of them together fail a right integrator with a chance of 1%
constexpr double kLevel = 0.01 / kTests;

class FinalGather : public testing::TestWithParam<int> {
 protected:
  std::string photonmap(const std::string& parameters) const {
    return fmt::format("Integrator \"photonmap\" \"integer finalgather\" {} {}\n", GetParam(), parameters);
  }
};

// A lamp of intensity I in the middle of a sphere of radius R and reflectance a: shadow rays bring E = I / R^2 to every
// point, a surface that was lit so sends a E to every point, and so on. Photons that end after m surfaces bring a E, ...,
// a^m E to the gather rays, so L = a / pi E (1 + a + ... + a^m). The part of a sphere within r of a point of it has the
// area pi r^2, so there is no blur.
constexpr double kReflectance[] = {0.8, 0.5, 0.2};
constexpr double kIntensity = 3, kRadius = 2;

Rgb radiance_within(int surfaces) {
  Rgb radiance;
  for (int c = 0; c < 3; ++c) {
    double sum = 0;
    for (int k = 0; k <= surfaces; ++k) sum += std::pow(kReflectance[c], k);
    radiance[c] = static_cast<float>(kReflectance[c] / std::acos(-1.) * kIntensity / (kRadius * kRadius) * sum);
  }
  return radiance;
}

std::string lit_sphere(const std::string& integrator) {
  return integrator + fmt::format(R"(
Camera "perspective" "float fov" 80
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "point" "rgb I" [{} {} {}]
Material "diffuse" "rgb reflectance" [{} {} {}]
Shape "sphere" "float radius" {}
)",
                                  kIntensity, kIntensity, kIntensity, kReflectance[0], kReflectance[1], kReflectance[2],
                                  kRadius);
}

TEST_P(FinalGather, BringsTheLightOfEverySurface) {
  for (const int surfaces : {1, 3}) {
    const std::string integrator =
        photonmap(fmt::format(R"("integer photons" 20000 "integer causticphotons" 1 "integer maxdepth" {})", surfaces));
    const Verdict verdict = agreement(rendered(lit_sphere(integrator), 2), radiance_within(surfaces), {kLevel, 0.002});
    EXPECT_TRUE(verdict.passed) << surfaces << " surfaces: " << verdict.message;
  }
}

using PhotonMapWithGlass = FinalGather;

// A clear glass ball in a furnace changes nothing: what comes from beyond it has the furnace's radiance, too. Gather rays
// go through it by two smooth lobes at least. Left out: what stays within the ball for more than four. Photons that met
// a matte surface belong to the global map whatever they pass, others to the caustic map.
TEST_P(PhotonMapWithGlass, IsAFurnaceStill) {
  constexpr float kAlbedo = 0.5f;
  const std::string integrator = photonmap(R"("integer photons" 20000 "integer causticphotons" 8000
"integer maxdepth" 30)");
  const std::string scene = integrator + fmt::format(R"(
LookAt 0 0 -1  0 0 0  0 1 0
Camera "perspective" "float fov" 80
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
AttributeBegin
  ReverseOrientation
  AreaLightSource "diffuse" "rgb L" [1 1 1]
  Material "diffuse" "rgb reflectance" [{} {} {}]
  Shape "sphere" "float radius" 2
AttributeEnd
Material "dielectric" "float eta" 1.5
Translate 0 0 .7
Shape "sphere" "float radius" 1
)",
                                                     kAlbedo, kAlbedo, kAlbedo);
  const Verdict verdict = agreement(rendered(scene, 2), Rgb(1 / (1 - kAlbedo)), {kLevel, 0.01});
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

constexpr const char* kBoxWithBall = R"(
Material "diffuse" "rgb reflectance" [.5 .5 .8]
Translate 0 -0.6 0.2
Shape "sphere" "float radius" 0.4)";

// A smooth coat over a diffuse base: gather rays choose between the two.
constexpr const char* kCoatedFurnace = R"(
Camera "perspective" "float fov" 80
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
ReverseOrientation
AreaLightSource "diffuse" "rgb L" [1 1 1]
Material "coateddiffuse" "rgb reflectance" [.8 .6 .4] "float roughness" 0
Shape "sphere" "float radius" 2)";

TEST_P(FinalGather, AgreesWithPath) {
  const auto with = [](const std::string& integrator) {
    return std::vector<std::string>{box(integrator, kBoxWithBall, 16), integrator + kCoatedFurnace};
  };
  static const std::vector<std::string> path = with("Integrator \"path\" \"integer maxdepth\" 20\n");
  static const std::vector<Tiles> expected = {rendered(path[0], 64), rendered(path[1], 16)};
  const std::vector<std::string> scenes = with(
      photonmap(R"("integer maxdepth" 20 "integer photons" 20000 "integer causticphotons" 10000 "float radius" 0.08)"));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Verdict verdict = agreement(rendered(scenes[i], 2), expected[i], {kLevel, 0.01});
    EXPECT_TRUE(verdict.passed) << scenes[i] << verdict.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Rays, FinalGather, testing::Values(1, 4));
INSTANTIATE_TEST_SUITE_P(Rays, PhotonMapWithGlass, testing::Values(0, 1, 4));

// Where pixels look through their middles at a wall that a point lights, gather rays alone are random, and theirs are
// counted on from iteration to iteration.
TEST(FinalGatherRays, AreThoseOfAsManyIterations) {
  const auto render = [](int rays, int iterations) {
    const std::string options = fmt::format(R"(Option "disablepixeljitter" true
Integrator "photonmap" "integer finalgather" {} "integer photons" 5000 "integer causticphotons" 1)",
                                            rays);
    return TestScene(lit_sphere(options)).render(FileFrame(0), iterations);
  };
  const Image together = render(4, 1), apart = render(1, 4), fewer = render(1, 3);
  for (std::size_t i = 0; i < together.pixels.size(); ++i) {
    EXPECT_NEAR(together.pixels[i].g, apart.pixels[i].g, 1e-5f * apart.pixels[i].g);
    EXPECT_NE(fewer.pixels[i], apart.pixels[i]);
  }
}

}  // namespace final_gather_test
}  // namespace dspm::test
