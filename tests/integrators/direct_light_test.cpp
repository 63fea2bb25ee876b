// Samples of direct light: of as many lights as there are, whichever outshines the others.
#include "dspm/integrators/transport/direct_light.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/testing/promises.h"
#include "tests/integrators/floor.h"

namespace dspm::test {
namespace direct_light_test {

enum class Lamps { points, balls };

/// In a ring above the floor, each twice as strong as the one before. Balls send the floor what points do: radiance
/// times pi r^2 is the intensity, and they hide one another from none of it.
std::string ring_of_lamps(int count, Lamps lamps = Lamps::points) {
  constexpr double kRadius = 0.03;
  std::string text;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPiExactly * i / count, intensity = std::ldexp(1, i % 8);
    const std::string place = fmt::format("{:.6f} {:.6f} .8", std::cos(angle), std::sin(angle));
    if (lamps == Lamps::points)
      text +=
          fmt::format("LightSource \"point\" \"rgb I\" [{0} {0} {0}] \"point3 from\" [{1}] \"string name\" \"{2}\"\n",
                      intensity, place, i);
    else
      text += fmt::format(
          "AttributeBegin Translate {1} AreaLightSource \"diffuse\" \"rgb L\" [{0} {0} {0}] Shape \"sphere\" "
          "\"float radius\" {2} AttributeEnd\n",
          intensity / (kPiExactly * kRadius * kRadius), place, kRadius);
  }
  return text;
}

/// Of every `step`-th lamp, from the first.
double irradiance_of_ring(int count, double x, double y, int first = 0, int step = 1) {
  double sum = 0;
  for (int i = first; i < count; i += step) {
    const double angle = 2 * kPiExactly * i / count;
    const double d = std::hypot(x - std::cos(angle), y - std::sin(angle), 0.8);
    sum += std::ldexp(1, i % 8) * 0.8 / (d * d * d);
  }
  return sum;
}

TEST(LightSamples, AsManyAsSaid) {
  const std::string sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n",
                    sun = "LightSource \"distant\" \"rgb L\" [3 3 3]\n",
                    suns = sun + sun + sun + sun + sky + sky + sky + sky + sky;
  for (const int count : {0, 1, 7, 9, 40})
    for (const std::string& far : {std::string(), sky + sun, suns}) {
      if (count == 0 && far.empty()) continue;
      const TestScene test(
          Floor{ring_of_lamps(count) + far + "LightSource \"point\" \"rgb I\" [0 0 0]\n"}.text("\"path\""));
      const auto scene = test.scene({FileFrame(0)});
      const bool few = scene->lights.size() <= 9;  // one is black
      for (const LightReceiver& at : {LightReceiver{{0.3f, 0.2f, 0}, {0, 0, 1}}, LightReceiver{{5, 0, -1}}}) {
        std::vector<int> samples(scene->lights.size());
        constexpr int kNumbers = 10'000;
        for (int i = 0; i < kNumbers; ++i)
          scene->direct_light.front().for_each(at, (i + 0.5) / kNumbers, [&](std::size_t light, float mean, int here) {
            EXPECT_NEAR(mean, light_samples(*scene, scene->lights[light], at), 1e-4f * mean);
            EXPECT_TRUE(!few || here == 1);
            samples[light] += here;
          });
        double all = 0;
        for (const SceneLight& light : scene->lights) {
          const auto mean = static_cast<double>(light_samples(*scene, light, at));
          EXPECT_NEAR(samples[static_cast<std::size_t>(&light - scene->lights.data())], mean * kNumbers, 10)
              << count << " lamps" << far;
          EXPECT_EQ(mean > 0, light.probability > 0) << "the black lamp is never sampled, and all others are";
          all += mean;
        }
        const double of_many = count == 0 ? 8 : far.empty() ? 4 : far == suns ? 4 + 4 : 4 + 2;
        EXPECT_NEAR(all, few ? static_cast<double>(scene->lights.size() - 1) : of_many, 1e-4);
      }
    }
}

/// The root mean square of a pixel's deviation from `exact`, over the mean.
double noise(const Image& image, const Image& exact) {
  double square = 0, sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double mean = static_cast<double>(exact.pixels[i].g);
    square += std::pow(static_cast<double>(image.pixels[i].g) - mean, 2), sum += mean;
  }
  return std::sqrt(square * static_cast<double>(image.pixels.size())) / sum;
}

class ManyLamps : public testing::TestWithParam<const char*> {};

TEST_P(ManyLamps, GiveTheirIrradiance) {
  for (const Lamps lamps : {Lamps::points, Lamps::balls})
    for (const int count : {7, 30}) {
      const Floor floor{ring_of_lamps(count, lamps)};
      const auto irradiance = [&](double x, double y) { return irradiance_of_ring(count, x, y); };
      const Tiles exact = tiles_of({{floor_picture(floor, irradiance)}});
      const Verdict verdict = agreement(rendered(floor.text(GetParam()), 12, seeds(12)), exact, {0.0005, 0.003});
      EXPECT_TRUE(verdict.passed) << count << (lamps == Lamps::points ? " points: " : " balls: ") << verdict.message;
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

// Variations that share no lamp choose on their own, so each samples its few lamps as if the file had no others.
TEST(SwitchedLamps, AreSampledInTheirVariation) {
  constexpr int kLamps = 40, kVariations = 5;
  std::string world = ring_of_lamps(kLamps);
  for (int v = 0; v < kVariations; ++v) {
    world += fmt::format("VariationBegin \"{}\"\n", v);
    for (int i = 0; i < kLamps; ++i)
      if (i % kVariations != v) world += fmt::format("Light \"{}\" \"float scale\" 0\n", i);
    world += "VariationEnd\n";
  }
  TestScene test(Floor{world}.text("\"path\""));
  ASSERT_EQ(test.frame_count(), kVariations);
  for (const int v : {0, 3}) {
    const auto scene = test.scene({FileFrame(v)});
    for (int i = 0; i < kLamps; ++i) {
      float mean = 0;
      for (const LightChoice& choice : scene->light_choices)
        if (!choice.frames.empty())
          mean = scene->direct_light[static_cast<std::size_t>(&choice - scene->light_choices.data())].mean(
              {}, static_cast<std::size_t>(i));
      EXPECT_EQ(mean, i % kVariations == v ? 1 : 0) << i;
    }
    const Floor floor{world};
    const Image exact =
        floor_picture(floor, [&](double x, double y) { return irradiance_of_ring(kLamps, x, y, v, kVariations); });
    EXPECT_LT(noise(test.render(FileFrame(v), 256), exact), 0.05);
  }
  const Verdict verdict = check_joint(Floor{world}.text(R"("path")"));
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

/// Small lamps of all shapes at random places over a floor with a glossy ball, and a mesh that is many lamps.
std::string lamps_of_all_shapes(int count) {
  std::string text, corners, indices;
  const auto number = [](int i, int k) {
    return static_cast<double>(PathRandom(3, Stream::setup, static_cast<std::uint64_t>(i), 0).number(0, k));
  };
  for (int i = 0; i < count; ++i) {
    const double x = 4 * number(i, 0) - 2, y = 4 * number(i, 1) - 2, z = 0.15 + 0.5 * number(i, 2);
    const char* shape = i % 3 == 0   ? R"(Shape "sphere" "float radius" .04)"
                        : i % 3 == 1 ? R"(Shape "disk" "float radius" .1)"
                                     : R"(Shape "trianglemesh" "point3 P" [0 0 0 .2 0 0 .2 .2 0 0 .2 .1]
                                           "integer indices" [0 1 2 0 2 3])";
    if (i % 4 != 0)
      text += fmt::format(R"(AttributeBegin Translate {:.3f} {:.3f} {:.3f} Rotate {:.1f} 1 .5 0
AreaLightSource "diffuse" "rgb L" [{} 8 8] {} AttributeEnd
)",
                          x, y, z, 100 + 160 * number(i, 3), i % 5 * 4, shape);
    corners += fmt::format("{0:.3f} {1:.3f} {2:.3f} {3:.3f} {1:.3f} {2:.3f} {0:.3f} {4:.3f} {2:.3f} ", x, y, z + 0.3,
                           x + 0.1, y + 0.1);
    indices += fmt::format("{} {} {} ", 3 * i, 3 * i + 2, 3 * i + 1);
  }
  return text + "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [9 9 4] Shape \"trianglemesh\" \"point3 P\" [" +
         corners + "] \"integer indices\" [" + indices + "] AttributeEnd\n";
}

// Shadow rays, scattered rays, photons and light subpaths find them, each weighted by the densities of the others: on a
// glossy floor all of them matter. A weight that took another density than the choice's would show.
TEST(ManyLampsOfAllShapes, AreFoundAlikeByAllIntegrators) {
  const std::string world = lamps_of_all_shapes(24) + R"(
Material "conductor" "float roughness" .3 "bool remaproughness" false
Translate 0 0 .02 Shape "disk" "float radius" 1.4
)";
  const auto text = [&](const char* integrator) { return Floor{.world = world, .max_depth = 2}.text(integrator); };
  const Tiles path = rendered(text(R"("path")"), 32, seeds(12));
  for (const char* other : {R"("vcm" "integer photons" 2000)", R"("dsppm" "integer photons" 4000 "float radius" .02)",
                            R"("dsppm" "integer photons" 4000 "float radius" .02 "float gatheralpha" 2)"}) {
    const Verdict verdict = agreement(rendered(text(other), 8, seeds(12)), path, {0.0005, 0.01});
    EXPECT_TRUE(verdict.passed) << other << ": " << verdict.message;
  }
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

}  // namespace direct_light_test
}  // namespace dspm::test
