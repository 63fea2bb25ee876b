// Samples of direct light: of as many lights as there are, whichever outshines the others.
#include "dspm/integrators/transport/direct_light.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "dspm/testing/promises.h"
#include "tests/integrators/floor.h"

namespace dspm::test {
namespace {

/// In a ring above the floor, each twice as strong as the one before.
std::string ring_of_lamps(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPiExactly * i / count;
    text += fmt::format("LightSource \"point\" \"rgb I\" [{0} {0} {0}] \"point3 from\" [{1:.6f} {2:.6f} .8]\n",
                        std::ldexp(1, i % 8), std::cos(angle), std::sin(angle));
  }
  return text;
}

double irradiance_of_ring(int count, double x, double y) {
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPiExactly * i / count;
    const double d = std::hypot(x - std::cos(angle), y - std::sin(angle), 0.8);
    sum += std::ldexp(1, i % 8) * 0.8 / (d * d * d);
  }
  return sum;
}

TEST(LightSamples, AsManyAsSaid) {
  for (const int count : {1, 8, 9, 40}) {
    const TestScene test(Floor{ring_of_lamps(count) + "LightSource \"point\" \"rgb I\" [0 0 0]\n"}.text("\"path\""));
    const auto scene = test.scene({FileFrame(0)});
    std::map<const SceneLight*, int> samples;
    constexpr int kNumbers = 10'000;
    for (int i = 0; i < kNumbers; ++i)
      for_each_light_sample(*scene, (static_cast<float>(i) + 0.5f) / kNumbers,
                            [&](const SceneLight& light) { ++samples[&light]; });
    for (const SceneLight& light : scene->lights)
      EXPECT_NEAR(samples[&light], static_cast<double>(light_samples(*scene, light)) * kNumbers, 5)
          << count << " lights";
  }
}

class ManyLamps : public testing::TestWithParam<const char*> {};

TEST_P(ManyLamps, GiveTheirIrradiance) {
  for (const int count : {7, 30}) {
    const Floor floor{ring_of_lamps(count)};
    const auto irradiance = [&](double x, double y) { return irradiance_of_ring(count, x, y); };
    const Tiles exact = tiles_of({{floor_picture(floor, irradiance)}});
    const Verdict verdict = agreement(rendered(floor.text(GetParam()), 12, seeds(16)), exact, {0.0005, 0.003});
    EXPECT_TRUE(verdict.passed) << count << " lamps: " << verdict.message;
  }
}

// Some lamps move and some do not, so frames choose from different samples, and part if they choose differently.
TEST_P(ManyLamps, EachFrameAsAlone) {
  for (const int moving : {3, 12}) {
    std::string world = ring_of_lamps(4);
    for (int i = 0; i < moving; ++i)
      world += fmt::format(R"(
DynamicBegin "lamp {0}"
  Keyframe 1 Translate {1} .2 .5 Rotate 180 1 0 0
  Keyframe {2} Translate {1} -.2 .6 Rotate 180 1 0 0 KeyframeEnd
  AreaLightSource "diffuse" "rgb L" [20 30 40]
  Shape "disk" "float radius" .02
DynamicEnd
)",
                           i, 0.15 * i - 0.9, 2 + i % 3);
    const Verdict verdict = check_joint("Frames 4\n" + Floor{world}.text(GetParam()));
    EXPECT_TRUE(verdict.passed) << moving << " moving lamps: " << verdict.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, ManyLamps,
                         testing::Values(R"("path")", R"("dsppm" "string direct" "sampled" "integer photons" 2000)"));

/// The root mean square of a pixel's deviation from `exact`, over the mean.
double noise(const Image& image, const Image& exact) {
  double square = 0, sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double mean = static_cast<double>(exact.pixels[i].g);
    square += std::pow(static_cast<double>(image.pixels[i].g) - mean, 2), sum += mean;
  }
  return std::sqrt(square * static_cast<double>(image.pixels.size())) / sum;
}

// A sky's power grows with the ground below it, though the light of a lamp does not get weaker.
TEST(LampBelowASky, IsSampledOnAnyGround) {
  for (const int radius : {10, 1000}) {
    const Floor floor{fmt::format(R"(
LightSource "infinite" "rgb L" [.1 .1 .1]
LightSource "point" "rgb I" [1 1 1] "point3 from" [0 0 1]
Translate 0 0 -.001
Shape "disk" "float radius" {})",
                                  radius)};
    const Image exact = floor_picture(floor, [](double x, double y) {
      const double d = std::hypot(x, y, 1);
      return 0.1 * kPiExactly + 1 / (d * d * d);
    });
    TestScene test(floor.text("\"path\""));
    EXPECT_LT(noise(test.render(FileFrame(0), 64), exact), 0.1) << "radius " << radius;
  }
}

// Mean and noise of what a glossy metal throws back of a small lamp, which its lobe seldom hits by chance: by a shadow
// ray and by the lobe as path does.
TEST(GlossyMetal, FindsASmallLampAsPathDoes) {
  const char* world = R"(
LookAt 0 0 2  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "infinite" "rgb L" [.2 .2 .2]
AttributeBegin
  Translate .3 .2 3 Rotate 180 1 0 0
  AreaLightSource "diffuse" "rgb L" [400 400 400]
  Shape "disk" "float radius" .05
AttributeEnd
Material "conductor" "float roughness" .15 "bool remaproughness" false
Shape "disk" "float radius" 1
)";
  const std::string glossy = std::string("Integrator \"dsppm\" \"integer photons\" 100\n") + world,
                    path = std::string("Integrator \"path\"\n") + world;
  const Verdict verdict = agreement(rendered(glossy, 64), rendered(path, 64));
  EXPECT_TRUE(verdict.passed) << verdict.message;
  const Image exact = TestScene(path).render(FileFrame(0), 4000);
  EXPECT_LT(noise(TestScene(glossy).render(FileFrame(0), 64), exact), 0.15);
}

}  // namespace
}  // namespace dspm::test
