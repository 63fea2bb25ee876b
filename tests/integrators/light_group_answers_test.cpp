// Light groups whose light is known: of lamps within a sphere, and of a light that is made brighter.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "dspm/session/job/choices.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/compare.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace light_group_answers_test {

class LightGroup : public testing::TestWithParam<const char*> {};

Choices with_groups() {
  Choices choices;
  choices.outputs = {"lights"};
  return choices;
}

/// Of a frame.
struct Parts {
  Image whole, key, other;
};

std::vector<Parts> rendered_parts(TestScene& test, int iterations) {
  std::vector<Parts> parts;
  for (const auto& frames : test.intervals()) {
    const auto scene = test.scene(frames);
    const auto integrator = test.integrator(*scene);
    for (int i = 0; i < iterations; ++i) integrator->iterate({i, *scene});
    for (Frame f = 0; f < scene->frame_count(); ++f)
      parts.push_back(
          {integrator->estimate(f), integrator->estimate(f, "light_key"), integrator->estimate(f, "light_other")});
  }
  return parts;
}

// Two lamps in the middle of a sphere of radius R and reflectance a, seen from there. That of intensity I brings E = I / R^2
// to every point and, scattered up to m - 1 times, the radiance a / pi E (1 + a + ... + a^(m - 1)), whatever the other
// does. The part of a sphere within r of a point of it has the area pi r^2, so there is no blur.
constexpr double kReflectance = 0.5, kRadius = 2;
constexpr int kDepth = 3;
constexpr double kKey[] = {3, 12}, kOther = 5;  // in each frame

Rgb radiance_of(double intensity) {
  double sum = 0;
  for (int k = 0; k < kDepth; ++k) sum += std::pow(kReflectance, k);
  return Rgb(static_cast<float>(kReflectance / std::acos(-1.) * intensity / (kRadius * kRadius) * sum));
}

TEST_P(LightGroup, ConvergesToTheLightOfItsLights) {
  constexpr int kSeeds = 16, kTests = 2 * 2 * 6;  // all of them together fail right integrators with a chance of 1%
  TestScene test(fmt::format(R"(
Frames 2
Integrator {} "integer maxdepth" {}
Camera "perspective" "float fov" 80
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "point" "string group" "key" "rgb I@1" [{} {} {}] "rgb I@2" [{} {} {}]
LightSource "point" "rgb I" [{} {} {}]
Material "diffuse" "rgb reflectance" [{} {} {}]
Shape "sphere" "float radius" {}
)",
                             GetParam(), kDepth, kKey[0], kKey[0], kKey[0], kKey[1], kKey[1], kKey[1], kOther, kOther,
                             kOther, kReflectance, kReflectance, kReflectance, kRadius),
                 with_groups());
  std::array<std::vector<std::vector<Image>>, 2> key, other;  // by frame and seed
  for (int seed = 1; seed <= kSeeds; ++seed) {
    test.set_seed(static_cast<std::uint64_t>(seed));
    const std::vector<Parts> frames = rendered_parts(test, 2);
    for (std::size_t f = 0; f < 2; ++f) key[f].push_back({frames[f].key}), other[f].push_back({frames[f].other});
  }
  const Tolerance tolerance{0.01 / kTests, 0.002};
  for (std::size_t f = 0; f < 2; ++f) {
    const Verdict of_key = agreement(tiles_of(key[f]), radiance_of(kKey[f]), tolerance),
                  of_other = agreement(tiles_of(other[f]), radiance_of(kOther), tolerance);
    EXPECT_TRUE(of_key.passed) << "frame " << f << of_key.message;
    EXPECT_TRUE(of_other.passed) << "frame " << f << of_other.message;
  }
}

/// Two spots that light no place both, one of them from above, the other by way of the ceiling; and a glass ball that moves.
std::string spots(const std::string& integrator, float key, float photons) {
  return fmt::format(R"(
Frames 2
Integrator {}
LookAt 0 2 -5  0 .5 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
WorldBegin
LightSource "spot" "string group" "key" "rgb I" [{} {} {}] "float photons" {} "point3 from" [-2 4 -1] "point3 to" [0 0 0]
LightSource "spot" "rgb I" [40 40 40] "point3 from" [2 1 0] "point3 to" [1 5 0]
Material "diffuse" "rgb reflectance" [.7 .6 .5]
AttributeBegin Rotate 90 1 0 0 Shape "disk" "float radius" 9 AttributeEnd
AttributeBegin Translate 0 5 0 Rotate 90 1 0 0 Shape "disk" "float radius" 9 AttributeEnd
DynamicBegin "ball"
  Keyframe 1 Translate -.8 .7 0 Keyframe 2 Translate .2 .7 0 KeyframeEnd
  Material "dielectric"
  Shape "sphere" "float radius" .5
DynamicEnd
)",
                     integrator, key, key, key, photons);
}

// Twice the light by as many photons: every photon of the key light carries twice as much, and nothing else changes.
TEST_P(LightGroup, ScalesWithItsLight) {
  TestScene before(spots(GetParam(), 40, 1), with_groups()), after(spots(GetParam(), 80, .5f), with_groups());
  const std::vector<Parts> dim = rendered_parts(before, 3), bright = rendered_parts(after, 3);
  for (std::size_t f = 0; f < dim.size(); ++f) {
    EXPECT_GT(mean(dim[f].key).r, 0.1f);
    EXPECT_GT(mean(dim[f].other).r, 0.01f);
    EXPECT_EQ(bright[f].other, dim[f].other);
    for (std::size_t i = 0; i < dim[f].whole.pixels.size(); ++i) {
      const Rgb &key = dim[f].key.pixels[i], &whole = dim[f].whole.pixels[i];
      EXPECT_EQ(bright[f].key.pixels[i], key * 2);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(bright[f].whole.pixels[i][c], whole[c] + key[c], 1e-5f * std::max(1.f, whole[c]));
    }
  }
}

constexpr const char* kPhotonIntegrators[] = {
    R"("dsppm" "integer photons" 3000 "string emission" "power" "string estimator" "hj09")",
    R"("dsppm" "integer photons" 3000 "string emission" "power" "string estimator" "hj09" "string direct" "photons")",
    R"("sppm" "integer photons" 3000 "string emission" "power" "string estimator" "hj09")",
    R"("photonmap" "integer photons" 3000 "integer causticphotons" 1000 "string emission" "power"
       "integer nearest" 10 "float radius" 1)",
    R"("photonmap" "integer photons" 3000 "integer nearest" 0 "integer causticphotons" 1000 "float radius" .2
       "string emission" "power")",
    // Brighter lamps might find that camera paths that go on pay.
    R"("dsppm" "integer photons" 3000 "string emission" "power" "string indirect" "photons")"};
INSTANTIATE_TEST_SUITE_P(Integrators, LightGroup, testing::ValuesIn(kPhotonIntegrators));

}  // namespace light_group_answers_test
}  // namespace dspm::test
