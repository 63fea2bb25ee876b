// Light that is refracted by its wavelength: where prisms throw it, in which colours, and that integrators agree about it and
// keep their promises.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "dspm/base/colour/wavelength.h"
#include "dspm/base/math/moments.h"
#include "dspm/materials/fresnel.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/compare.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/scattering.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/box_scene.h"
#include "tests/support/seeds.h"

namespace dspm::test {
namespace dispersion_test {

constexpr double kApex = 25 * 3.14159265358979323846 / 180;
constexpr int kIterations = 64, kWidth = 96, kBowIterations = 32;

constexpr const char* kByPhotons[] = {
    R"("dsppm" "integer photons" 150000 "float radius" 0.01)",
    R"("dsppm" "integer photons" 150000 "float radius" 0.01 "string estimator" "hj09" "string direct" "photons")",
    R"("sppm" "integer photons" 150000 "float radius" 0.01)",
    R"("vcm" "integer photons" 150000)",
};

/// A prism below a slit through which a sun shines straight down: light leaves by its sloping face, 2 above the floor. The
/// camera looks down from beneath the prism.
std::string under_prism(const std::string& integrator, const std::string& below) {
  const double slope = std::tan(kApex), half = 0.3;
  return fmt::format(R"(
Integrator {0} "integer maxdepth" 12
LookAt 0.9 0 1  0.9 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-.2 .2 -.1 .1]
PixelFilter "box"
Film "rgb" "integer xresolution" {1} "integer yresolution" 48
WorldBegin
LightSource "distant" "rgb L" [1 1 1] "point3 from" [0 0 1] "point3 to" [0 0 0]
Material "diffuse" "rgb reflectance" [1 1 1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [.6 -.1 0  1.3 -.1 0  1.3 .1 0  .6 .1 0]
Material "diffuse" "rgb reflectance" [0 0 0]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-.35 -.1 3  -.01 -.1 3  -.01 .1 3  -.35 .1 3]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [.01 -.1 3  1.4 -.1 3  1.4 .1 3  .01 .1 3]
Material "dielectric" "string glass" "SF11"
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7]
  "point3 P" [-{2} -.1 {3}  {2} -.1 {4}  {2} .1 {4}  -{2} .1 {3}  -{2} -.1 2.5  {2} -.1 2.5  {2} .1 2.5  -{2} .1 2.5]
{5})",
                     integrator, kWidth, half, 2 + half * slope, 2 - half * slope, below);
}

/// What a channel of the image receives in total, and its mean place along x.
struct Channel {
  double sum = 0, place = 0;
};
std::array<Channel, 3> channels_of(const Image& image) {
  std::array<Channel, 3> channels;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double value = double{image.at(x, y)[c]};
        channels[static_cast<std::size_t>(c)].sum += value;
        channels[static_cast<std::size_t>(c)].place += value * (0.9 + (0.5 - (x + 0.5) / kWidth) * 0.4);
      }
  for (Channel& channel : channels) channel.place /= channel.sum;
  return channels;
}

/// What the wavelengths of the iterations bring, by Snell and Fresnel: the sums up to a factor that all channels have.
std::array<Channel, 3> expected() {
  const auto glass = material_of(R"("dielectric" "string glass" "SF11")");
  std::array<Channel, 3> channels;
  for (int i = 0; i < kIterations; ++i) {
    const std::int16_t nm = wavelength_of(0, static_cast<std::uint64_t>(i));
    const float eta = glass->eta_at({.nm = nm});
    const double through = double{1 - fresnel_dielectric(1, eta)} *
                           double{1 - fresnel_dielectric(static_cast<float>(std::cos(kApex)), 1 / eta)};
    const double place = 2 * std::tan(std::asin(double{eta} * std::sin(kApex)) - kApex);
    for (int c = 0; c < 3; ++c) {
      const double power = through * double{hue(nm)[c]};
      channels[static_cast<std::size_t>(c)].sum += power, channels[static_cast<std::size_t>(c)].place += power * place;
    }
  }
  for (Channel& channel : channels) channel.place /= channel.sum;
  return channels;
}

void expect_sums_in_proportion(const std::array<Channel, 3>& found, double tolerance) {
  const std::array<Channel, 3> right = expected();
  for (std::size_t c : {std::size_t{0}, std::size_t{2}})
    EXPECT_NEAR(found[c].sum / found[1].sum / (right[c].sum / right[1].sum), 1, tolerance) << c;
}

TEST(Prism, ThrowsEachColourWhereItsIndexSays) {
  const std::array<Channel, 3> right = expected();
  EXPECT_GT(right[2].place - right[0].place, 0.03);
  for (const char* integrator : kByPhotons) {
    SCOPED_TRACE(integrator);
    const auto found = channels_of(TestScene(under_prism(integrator, "")).render(FileFrame(0), kIterations));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c].place, right[c].place, 0.002) << c;
    expect_sums_in_proportion(found, 0.045);
  }
}

// A pane of the same glass before the camera: both paths have one wavelength then, and its hue counts once.
TEST(Prism, HuesCountOnce) {
  const std::string pane = R"(
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7]
  "point3 P" [.5 -.2 .4  1.4 -.2 .4  1.4 .2 .4  .5 .2 .4  .5 -.2 .6  1.4 -.2 .6  1.4 .2 .6  .5 .2 .6])";
  for (const char* integrator : kByPhotons) {
    SCOPED_TRACE(integrator);
    const auto found = channels_of(TestScene(under_prism(integrator, pane)).render(FileFrame(0), kIterations));
    expect_sums_in_proportion(found, 0.06);
  }
}

// A second prism, which turns the light back, with a narrow gap in between.
TEST(Prism, ASecondOneMakesWhiteAgain) {
  const double slope = std::tan(kApex), half = 0.3, gap = 0.02;
  const std::string second = fmt::format(R"(
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7]
  "point3 P" [-{0} -.1 1.5  {0} -.1 1.5  {0} .1 1.5  -{0} .1 1.5  -{0} -.1 {1}  {0} -.1 {2}  {0} .1 {2}  -{0} .1 {1}])",
                                         half, 2 - gap + half * slope, 2 - gap - half * slope);
  for (const char* integrator : kByPhotons) {
    SCOPED_TRACE(integrator);
    std::string text = under_prism(integrator, second);
    replace(text, "LookAt 0.9 0 1  0.9 0 0", "LookAt 0 0 1  0 0 0");
    replace(text, "[.6 -.1 0  1.3 -.1 0  1.3 .1 0  .6 .1 0]", "[-.3 -.1 0  .3 -.1 0  .3 .1 0  -.3 .1 0]");
    const auto found = channels_of(TestScene(text).render(FileFrame(0), kIterations));
    EXPECT_NEAR(found[0].place, found[2].place, 0.002);
    expect_sums_in_proportion(found, 0.045);
  }
}

/// A drop of water sends part of a beam along z back onto a screen 100 away. Returns what the screen gets between the
/// radii 78 and 95, by Snell and Fresnel: a bow of 42 degrees.
std::array<Channel, 3> expected_bow() {
  constexpr int kBeams = 20'000;
  const auto water = material_of(R"("dielectric" "string glass" "water")");
  std::array<Channel, 3> channels;
  for (int i = 0; i < kBowIterations; ++i) {
    const std::int16_t nm = wavelength_of(0, static_cast<std::uint64_t>(i));
    const double eta = double{water->eta_at({.nm = nm})};
    const auto add = [&](double back, double out, double power,
                         const Spectrum& of) {  // angles to the axis: of ray and exit
      const double place = std::sin(out) + (100 - std::cos(out)) * std::tan(back);
      if (back > 1.5 || place < 78 || place > 95) return;
      for (std::size_t c = 0; c < 3; ++c) {
        const double part = power / place * double{of[static_cast<int>(c)]};  // of a ring in the picture
        channels[c].sum += part, channels[c].place += part * place;
      }
    };
    for (int beam = 0; beam < kBeams; ++beam) {
      const double b = std::sqrt((beam + 0.5) / kBeams), in = std::asin(b), inside = std::asin(b / eta),
                   spread = std::asin(b / 400);
      const auto fresnel = [&](double index) {
        return double{fresnel_dielectric(static_cast<float>(std::cos(in)), static_cast<float>(index))};
      };
      const double mirrored = fresnel(eta), back = 4 * inside - 2 * in;
      add(back + spread, back + in + spread, (1 - mirrored) * mirrored * (1 - mirrored), hue(nm));
      add(2 * in - spread, in - spread, fresnel(double{water->eta()}), Spectrum(1));  // by the drop's front
    }
  }
  for (Channel& channel : channels) channel.place /= channel.sum;
  return channels;
}

TEST(Rainbow, StandsAt42Degrees) {
  const std::array<Channel, 3> right = expected_bow();
  EXPECT_GT(right[0].place - right[2].place, 0.5);
  const std::string scene = fmt::format(R"(
Integrator "dsppm" "integer photons" 500000 "integer maxdepth" 6
LookAt 0 0 10  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [78 95 -4 4]
PixelFilter "box"
Film "rgb" "integer xresolution" 85 "integer yresolution" 40
WorldBegin
LightSource "spot" "rgb I" [1e6 1e6 1e6] "point3 from" [0 0 -400] "point3 to" [0 0 0] "float coneangle" .16 "float conedeltaangle" .001
Material "diffuse" "rgb reflectance" [1 1 1]
AttributeBegin Translate 0 0 -100 Shape "disk" "float radius" 110 "float innerradius" 1.5 AttributeEnd
Material "dielectric" "string glass" "water"
Shape "sphere")");
  const Image image = TestScene(scene).render(FileFrame(0), kBowIterations);
  std::array<Channel, 3> found;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double value = double{image.at(x, y)[c]};
        const double across = 78 + (x + 0.5) * 0.2, up = (y + 0.5) * 0.2 - 4;
        found[static_cast<std::size_t>(c)].sum += value;
        found[static_cast<std::size_t>(c)].place += value * std::sqrt(across * across + up * up);
      }
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c].place / found[c].sum, right[c].place, 0.2) << c;
}

// One flint ball is seen through another; all of its light can be found by path.
std::string two_balls(const std::string& integrator, const std::string& roughness) {
  const std::string flint = fmt::format("Material \"dielectric\" \"string glass\" \"SF11\" {}\n", roughness);
  return box("Integrator " + integrator + " \"integer maxdepth\" 16\n", flint + R"(
AttributeBegin Translate -0.3 -0.5 0.3 Shape "sphere" "float radius" 0.4 AttributeEnd
AttributeBegin Translate 0.25 -0.6 -0.5 Shape "sphere" "float radius" 0.35 AttributeEnd)",
             32);
}

TEST(Dispersion, IntegratorsAgree) {
  constexpr int kSeeds = 8;
  for (const char* roughness : {"", R"("float roughness" 0.1)"}) {
    const auto of = [&](const char* integrator, int iterations) {
      return rendered(two_balls(integrator, roughness), iterations, seeds(kSeeds), 2);
    };
    const Tiles path = of(R"("path")", 96);
    for (const char* integrator :
         {R"("dsppm" "integer photons" 6000 "float radius" 0.04)",
          R"("sppm" "integer photons" 6000 "float radius" 0.04 "string estimator" "hj09")",
          R"("vcm" "integer photons" 1000)", R"("vcm" "integer photons" 1000 "bool merge" false)"}) {
      const Verdict verdict = agreement(of(integrator, 24), path, {0.001, 0.02});
      EXPECT_TRUE(verdict.passed) << integrator << roughness << ": " << verdict.message;
    }
    // Its photons have wavelengths of their own, and are blurred.
    const Verdict verdict = agreement(
        of(R"("photonmap" "integer photons" 20000 "integer causticphotons" 40000 "float radius" 0.08 "float causticradius" 0.04)",
           24),
        path, {0.001, 0.04});
    EXPECT_TRUE(verdict.passed) << roughness << verdict.message;
  }
}

// Where bodies overlap, the index around a surface is that of the wavelength, too: the same glass in itself is not there.
TEST(Dispersion, GlassInTheSameGlassIsNotThere) {
  const auto with = [](const std::string& inner) {
    return box("Integrator \"path\" \"integer maxdepth\" 12\n", R"(
Material "dielectric" "string glass" "SF11" "integer priority" 1
Shape "sphere" "float radius" 0.7
)" + inner,
               16);
  };
  const Image alone = TestScene(with("")).render(FileFrame(0), 128);
  const Image nested = TestScene(with(R"(Material "dielectric" "string glass" "SF11" "integer priority" 2
Shape "sphere" "float radius" 0.3)"))
                           .render(FileFrame(0), 128);
  const Rgb a = mean(alone), b = mean(nested);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 0.02f * a[c]);
}

// A ball that turns to other glass, another one that moves, and finishes some of which do not disperse.
std::string changing(const std::string& integrator) {
  return box("Frames 3\nIntegrator " + integrator + "\n",
             R"(
MakeNamedMaterial "finish" "string type" "dielectric" "string glass" "SF11"
DynamicBegin "ball" Keyframe 1 Translate -0.3 -0.5 0.3 Keyframe 3 Translate -0.1 -0.5 0.3 KeyframeEnd
  Material "principled" "float transmission" 1 "float roughness" 0.3 "float abbe" 20
  Shape "sphere" "float radius" 0.4 DynamicEnd
AttributeBegin Translate 0.25 -0.6 -0.5 NamedMaterial "finish" Shape "sphere" "float radius" 0.35 AttributeEnd
VariationBegin "flint" VariationEnd
VariationBegin "crown" MakeNamedMaterial "finish" "string type" "dielectric" "string glass" "BK7" VariationEnd
VariationBegin "plain" MakeNamedMaterial "finish" "string type" "dielectric" "float eta" 1.78 VariationEnd)",
             16);
}

TEST(Dispersion, KeepsThePromises) {
  for (const char* integrator :
       {R"("dsppm" "integer photons" 2000)", R"("dsppm" "integer photons" 2000 "string estimator" "hj09")",
        R"("sppm" "integer photons" 2000)", R"("path")", R"("vcm" "integer photons" 1000)",
        R"("photonmap" "integer photons" 2000 "integer causticphotons" 2000)"}) {
    for (const auto& check : {check_threads, check_resume, check_joint, check_crop}) {
      const Verdict verdict = check(changing(integrator), 3);
      EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
    }
  }
}

}  // namespace dispersion_test
}  // namespace dspm::test
