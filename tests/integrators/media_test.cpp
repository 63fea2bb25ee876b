// Light through media, where formulas and quadrature know the answer.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/integrators/beside/surface_output_list.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/session/job/choices.h"
#include "dspm/testing/compare.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace media_test {

using test::TestScene;

/// What the camera at (0, 0, -3) sees along z, in a narrow cone, from within the medium that `around` names.
std::string looking(const std::string& integrator, const std::string& media, const std::string& contents,
                    const std::string& around = "", const std::string& frames = "") {
  return fmt::format(R"(
{}
Integrator {}
PixelFilter "box"
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
{}
LookAt 0 0 -3  0 0 0  0 1 0
{}
Camera "perspective" "float fov" 0.02
WorldBegin
{}
)",
                     frames, integrator, media,
                     around.empty() ? "" : fmt::format("MediumInterface \"\" \"{}\"", around), contents);
}

const std::string kSky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";
const std::string kPath = R"("path" "integer maxdepth" 100)";

/// Those that see media, with that many bounces.
std::vector<std::string> integrators(int bounces) {
  return {
      fmt::format(R"("path" "integer maxdepth" {})", bounces),
      fmt::format(R"("dsppm" "integer maxdepth" {} "integer photons" 20000 "float radius" .2)", bounces),
      fmt::format(R"("sppm" "integer maxdepth" {} "integer photons" 20000 "float radius" .2 "string estimator" "hj09")",
                  bounces),
      fmt::format(R"("photonmap" "integer maxdepth" {} "integer photons" 400000 "integer causticphotons" 1000
  "float causticradius" .14)",
                  bounces),
      fmt::format(R"("vcm" "integer maxdepth" {} "integer photons" 500 "float radius" .05)", bounces)};
}
bool has_photons(const std::string& integrator) {
  return integrator.find("ppm") != std::string::npos || integrator.find("photonmap") != std::string::npos;
}

/// Returns how many iterations it takes: of vcm more, as two subpaths have weights for their colours.
int iterations(const std::string& integrator, int with_photons, int of_path) {
  return has_photons(integrator) ? with_photons : integrator.find("vcm") != std::string::npos ? 4 * of_path : of_path;
}

/// A ball of radius 1 at the origin, filled with the medium; nothing is its surface.
std::string ball_of(const std::string& medium, const std::string& outside = "") {
  return fmt::format(
      "AttributeBegin MediumInterface \"{}\" \"{}\" Material \"interface\" Shape \"sphere\" AttributeEnd\n", medium,
      outside);
}
std::string homogeneous(const std::string& name, const std::string& params) {
  return fmt::format("MakeNamedMedium \"{}\" \"string type\" \"homogeneous\" {}\n", name, params);
}

std::string smoke(const std::string& density) {
  return fmt::format(R"(MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 2 "integer ny" 1 "integer nz" 2
  "float density" [1 2 3 1] "point3 p0" [-2 -2 -2] "point3 p1" [2 2 2] "rgb sigma_a" [.1 .2 .1] {}
)",
                     density);
}

Rgb mean_of(const std::string& text, int iterations) { return mean(TestScene(text).render(FileFrame(0), iterations)); }

void expect_colour(const Rgb& seen, double r, double g, double b, double error) {
  EXPECT_NEAR(static_cast<double>(seen.r), r, error);
  EXPECT_NEAR(static_cast<double>(seen.g), g, error);
  EXPECT_NEAR(static_cast<double>(seen.b), b, error);
}

/// Integrates over [low, high] by Simpson's rule.
template <class Fn>
double integral(double low, double high, const Fn& fn) {
  constexpr int kSteps = 20'000;
  const double h = (high - low) / kSteps;
  double sum = fn(low) + fn(high);
  for (int i = 1; i < kSteps; ++i) sum += fn(low + i * h) * (i % 2 != 0 ? 4 : 2);
  return sum * h / 3;
}

// exp(-2 sigma_a) of the sky is left, in each colour.
TEST(Media, AbsorbByBeersLaw) {
  for (const std::string& integrator : integrators(8)) {
    const Rgb seen = mean_of(looking(integrator, homogeneous("ink", R"("rgb sigma_a" [.1 .4 1] "rgb sigma_s" [0 0 0])"),
                                     kSky + ball_of("ink")),
                             has_photons(integrator) ? 2 : 600);
    expect_colour(seen, std::exp(-0.2), std::exp(-0.8), std::exp(-2.), has_photons(integrator) ? 1e-5 : 0.012);
  }
}

// A shadow ray computes what is left: without noise.
TEST(Media, DimLampsByBeersLaw) {
  const std::string lamp = R"(LightSource "distant" "rgb L" [1 1 1] "point3 from" [0 0 -1] "point3 to" [0 0 0]
Material "diffuse" "rgb reflectance" [1 1 1]
Translate 0 0 2 Shape "disk" "float radius" 5
)";
  // The camera looks past the ball, whose shadow is looked at from the other side.
  const std::string seen_from_behind = R"(
LookAt 0 -3 1.9  0 0 2  0 0 1
Camera "perspective" "float fov" 0.02
)";
  std::string text =
      looking(R"("path" "integer maxdepth" 1)", homogeneous("ink", R"("rgb sigma_a" [.1 .4 1] "rgb sigma_s" [0 0 0])"),
              ball_of("ink") + lamp);
  const std::size_t camera = text.find("LookAt"), world = text.find("WorldBegin");
  text.replace(camera, world - camera, seen_from_behind);
  const Rgb seen = mean_of(text, 2);
  constexpr double kPi = 3.14159265358979;
  expect_colour(seen, std::exp(-0.2) / kPi, std::exp(-0.8) / kPi, std::exp(-2.) / kPi, 2e-5);
}

// Le (1 - exp(-2 sigma_a)).
TEST(Media, Glow) {
  for (const std::string& integrator : integrators(8)) {
    const Rgb seen = mean_of(
        looking(integrator, homogeneous("flame", R"("rgb sigma_a" [.2 .5 2] "rgb sigma_s" [0 0 0] "rgb Le" [3 2 1])"),
                ball_of("flame")),
        has_photons(integrator) ? 2 : 600);
    expect_colour(seen, 3 * (1 - std::exp(-0.4)), 2 * (1 - std::exp(-1.)), 1 - std::exp(-4.),
                  has_photons(integrator) ? 1e-5 : 0.03);
  }
}

// One scattering in endless fog: the integral of sigma_s exp(-sigma_t (s + d)) I p / d^2 along the ray, for a lamp beside it.
TEST(Media, ScatterALampsLightOnce) {
  for (const std::string& integrator : integrators(1))
    for (const double g : {0., 0.6, -0.4}) {
      const Rgb seen = mean_of(
          looking(
              integrator,
              homogeneous("fog", fmt::format(R"("rgb sigma_a" [.05 .1 .3] "rgb sigma_s" [.2 .2 .1] "float g" {})", g)),
              R"(LightSource "point" "rgb I" [10 10 10] "point3 from" [0 1.5 0])", "fog"),
          has_photons(integrator) ? 30 : 2000);
      const auto expected = [&](double sigma_a, double sigma_s) {
        return integral(0, 60, [&](double s) {
          const double z = s - 3, d = std::hypot(1.5, z), cosine = -z / d, sigma_t = sigma_a + sigma_s;
          const double phase = (1 - g * g) / (4 * 3.14159265358979 * std::pow(1 + g * g - 2 * g * cosine, 1.5));
          return sigma_s * std::exp(-sigma_t * (s + d)) * 10 * phase / (d * d);
        });
      };
      const double r = expected(0.05, 0.2), green = expected(0.1, 0.2), b = expected(0.3, 0.1);
      EXPECT_NEAR(static_cast<double>(seen.r) / r, 1, 0.03) << integrator << g;
      EXPECT_NEAR(static_cast<double>(seen.g) / green, 1, 0.03) << integrator << g;
      EXPECT_NEAR(static_cast<double>(seen.b) / b, 1, 0.03) << integrator << g;
    }
}

// Shadow rays bring a beam what `path` finds at its collisions, whatever the light and the medium: lamps with and without a surface,
// a spot that lights a part of the beam, more lamps than are all sampled, a sky; a medium that varies, in two boxes of which
// one has nothing of it.
TEST(Media, AreLitByAllLights) {
  const std::string fog = homogeneous("fog", R"("rgb sigma_a" [.05 .1 0] "rgb sigma_s" [.2 .5 2] "float g" .4)");
  const std::string cloud = smoke(R"("rgb sigma_s" [.3 .3 .9] "float g" -.3)");
  std::string many;
  for (int i = 0; i < 12; ++i)
    many += fmt::format("LightSource \"point\" \"rgb I\" [{0} {0} {0}] \"point3 from\" [{1} {2} {3}]\n", 1 + i % 3,
                        2 * std::cos(i), 2 * std::sin(i), 0.3 * i - 2);
  const std::string lamp = R"(AttributeBegin Translate 0 1.4 0 AreaLightSource "diffuse" "rgb L" [9 6 4]
  Shape "sphere" "float radius" .3 AttributeEnd
)";
  const std::string spot =
      R"(LightSource "spot" "rgb I" [20 20 30] "point3 from" [1 1.5 -.5] "point3 to" [0 0 .3] "float coneangle" 20
LightSource "distant" "rgb L" [.2 .3 .2] "point3 from" [1 1 -1]
)";
  const std::string mixed = R"(AttributeBegin MediumInterface "smoke" "" Material "interface"
  Shape "sphere" "float radius" 1.3 AttributeEnd
)";
  for (const std::string& lights : {many, lamp, spot, lamp + many, kSky + spot})
    for (const std::string& contents : {ball_of("fog"), mixed}) {
      const auto seen = [&](const std::string& integrator, int iterations) {
        return mean_of(looking(integrator, fog + cloud, lights + contents), iterations);
      };
      const Rgb expected = seen(R"("path" "integer maxdepth" 1)", 2000);
      const Rgb by_rays = seen(R"("dsppm" "integer maxdepth" 1 "integer photons" 50)", 500);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<double>(by_rays[c] / expected[c]), 1, 0.03) << lights << contents << c;
    }
}

// A flame beside what the camera sees lights a wall, also if its border cuts it, or if it is the same everywhere: in each of the ways
// in which photons share the light with rays.
TEST(Media, LightSurfacesIfTheyGlow) {
  const std::string wall = R"(Material "diffuse" "rgb reflectance" [.8 .8 .8]
AttributeBegin Translate 0 0 1 Shape "disk" "float radius" 8 AttributeEnd
)";
  const auto flame = [&](const std::string& medium, double radius) {
    return fmt::format(R"({}{}AttributeBegin MediumInterface "flame" "" Material "interface" Translate 1.2 1 0
  Shape "sphere" "float radius" {} AttributeEnd
)",
                       medium, wall, radius);
  };
  const std::string fire =
      R"(MakeNamedMedium "flame" "string type" "uniformgrid" "integer nx" 2 "integer ny" 2 "integer nz" 2
  "float density" [1 0 2 5 3 0 0 4] "point3 p0" [.8 .6 -.5] "point3 p1" [1.6 1.4 .5] "rgb sigma_a" [1 1 2]
  "rgb sigma_s" [.5 .5 .5] "rgb Le" [9 5 2]
)";
  const std::string gas = homogeneous("flame", R"("rgb sigma_a" [1 .5 1] "rgb sigma_s" [0 0 0] "rgb Le" [9 5 2])");
  for (const std::string& contents : {flame(fire, 0.8), flame(fire, 0.4), flame(gas, 0.4)}) {
    const auto seen = [&](const std::string& integrator, int iterations) {
      return mean_of(looking(integrator, "", contents), iterations);
    };
    const Rgb expected = seen(R"("path" "integer maxdepth" 3)", 2500);
    for (const char* ways : {"", R"("string direct" "photons")", R"("string direct" "sampled")"}) {
      if (*ways != 0 && contents != flame(gas, 0.4)) continue;
      const Rgb by_photons =
          seen(fmt::format(R"("dsppm" "integer maxdepth" 3 "integer photons" 40000 "float radius" .6 {})", ways), 30);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<double>(by_photons[c] / expected[c]), 1, 0.06) << ways << contents << c;
    }
  }
}

// Over another background, what media leave of it is seen: 1 - exp(-2 sigma_a), the mean of the colours.
TEST(Media, HideABackgroundInPart) {
  for (const std::string& integrator : integrators(8)) {
    std::string text = looking(integrator, homogeneous("ink", R"("rgb sigma_a" [.1 .4 1] "rgb sigma_s" [0 0 0])"),
                               kSky + ball_of("ink"));
    text.replace(text.find("\"integer yresolution\" 8"), 0, "\"bool transparent\" true ");
    TestScene test(text);
    const std::unique_ptr<Scene> scene = test.scene(test.all_frames());
    const std::unique_ptr<Integrator> made = test.integrator(*scene);
    test.iterate(*made, *scene, 0, 4);
    const double alpha = 1 - (std::exp(-0.2) + std::exp(-0.8) + std::exp(-2.)) / 3;
    expect_colour(mean(made->estimate(0, kAlphaOutput)), alpha, alpha, alpha, 1e-4);
    expect_colour(mean(made->estimate(0)), 0, 0, 0, 0);
  }
}

Choices with_volume() {
  Choices choices;
  choices.outputs = {kVolumeOutput};
  return choices;
}

// In front of a sky, what a flame gives off is the layer "volume", and the rest of the image the sky.
TEST(Media, HaveALayerOfTheirOwn) {
  const std::string flame = homogeneous("flame", R"("rgb sigma_a" [.2 .5 2] "rgb sigma_s" [0 0 0] "rgb Le" [3 2 1])");
  for (const std::string& integrator : integrators(8)) {
    TestScene test(looking(integrator, flame, kSky + ball_of("flame")), with_volume());
    const std::unique_ptr<Scene> scene = test.scene(test.all_frames());
    const std::unique_ptr<Integrator> made = test.integrator(*scene);
    const int iterations = has_photons(integrator) ? 2 : 400;
    test.iterate(*made, *scene, 0, iterations);
    const double left[] = {std::exp(-0.4), std::exp(-1.), std::exp(-4.)}, error = has_photons(integrator) ? 1e-5 : 0.04;
    const Rgb volume = mean(made->estimate(0, kVolumeOutput)), image = mean(made->estimate(0));
    expect_colour(volume, 3 * (1 - left[0]), 2 * (1 - left[1]), 1 - left[2], error);
    expect_colour(image + volume * -1.f, left[0], left[1], left[2], error);
  }
}

// Light that surfaces scatter into fog is in it, light that fog scatters to surfaces is not.
TEST(Media, HaveInTheirLayerWhatTheySend) {
  const std::string fog = homogeneous("fog", R"("rgb sigma_a" [.1 .1 .1] "rgb sigma_s" [.6 .3 .6])");
  const std::string contents = ball_of("fog") + R"(
Material "diffuse" "rgb reflectance" [.8 .8 .8]
LightSource "point" "rgb I" [10 10 10] "point3 from" [0 2 .5]
Translate 0 0 1.5 Shape "disk" "float radius" 5
)";
  Rgb volume, image;
  for (const std::string& integrator : integrators(4)) {
    std::string text = looking(integrator, fog, contents);
    text.replace(text.find("fov\" 0.02"), 9, "fov\" 50");  // so that vcm's light subpaths find the camera
    TestScene test(text, with_volume());
    const std::unique_ptr<Scene> scene = test.scene(test.all_frames());
    const std::unique_ptr<Integrator> made = test.integrator(*scene);
    test.iterate(*made, *scene, 0, has_photons(integrator) ? 30 : 1000);
    const Rgb own_volume = mean(made->estimate(0, kVolumeOutput)), own_image = mean(made->estimate(0));
    if (is_black(volume)) volume = own_volume, image = own_image;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(static_cast<double>(own_volume[c] / volume[c]), 1, 0.05) << integrator << c;
      EXPECT_NEAR(static_cast<double>(own_image[c] / image[c]), 1, 0.05) << integrator << c;
      EXPECT_LT(own_volume[c], 0.8f * own_image[c]) << integrator << c;
    }
  }
}

// A sky beyond fog without end is not seen, and lights nothing.
TEST(Media, WithoutEndHideTheSky) {
  const std::string fog = homogeneous("fog", R"("rgb sigma_a" [.1 .1 .1] "rgb sigma_s" [.2 .2 .2])");
  const std::string contents = kSky + R"(
LightSource "distant" "rgb L" [9 9 9] "point3 from" [1 1 -1]
Material "diffuse" "rgb reflectance" [.8 .8 .8]
Translate 0 0 1.5 Shape "disk" "float radius" 5
)";
  for (const std::string& integrator : integrators(4)) {
    std::string text = looking(integrator, fog, contents, "fog");
    const std::string outside = R"(MediumInterface "" "fog")";
    text.replace(text.find(outside), outside.size(), R"(MediumInterface "fog")");  // on both sides of the disk
    text.replace(text.find("fov\" 0.02"), 9, "fov\" 50");
    EXPECT_EQ(max_component(mean_of(text, 4)), 0) << integrator;
  }
}

// Where light is the same from everywhere, what only scatters it cannot be seen, however it does.
TEST(Media, AreInvisibleInAWhiteFurnace) {
  const std::string milk = homogeneous("milk", R"("rgb sigma_a" [0 0 0] "rgb sigma_s" [1 3 .2] "float g" .7)");
  const std::string smoke = R"(MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 2 "integer ny" 2
  "integer nz" 2 "float density" [1 0 2 5 3 0 0 4] "rgb sigma_a" [0 0 0] "rgb sigma_s" [1 .5 2] "point3 p0" [-1 -1 -1]
)";
  const std::string glass =
      R"(AttributeBegin MediumInterface "milk" "" Material "dielectric" Shape "sphere" AttributeEnd
)";
  const std::string in_mist =
      R"(AttributeBegin MediumInterface "milk" "smoke" Material "dielectric" Shape "sphere" "float radius" .4 AttributeEnd
AttributeBegin MediumInterface "smoke" "" Material "interface" Shape "sphere" "float radius" 2 AttributeEnd
)";
  for (const std::string& integrator : integrators(2000))
    for (const std::string& contents : {ball_of("milk"), ball_of("smoke"), glass, in_mist}) {
      const Rgb seen = mean_of(looking(integrator, milk + smoke, kSky + contents), iterations(integrator, 16, 400));
      expect_colour(seen, 1, 1, 1, has_photons(integrator) ? 0.1 : 0.025);
    }
}

// The same inside: L = 1 + albedo L on a sphere that glows with 1, whatever is in it.
TEST(Media, LeaveAFurnaceAsItIs) {
  for (const char* params : {R"("rgb sigma_a" [0 0 0] "rgb sigma_s" [.5 .5 .5])",
                             R"("rgb sigma_a" [0 0 0] "rgb sigma_s" [2 .1 0] "float g" -.5)"}) {
    const std::string sphere = R"(AreaLightSource "diffuse" "rgb L" [1 1 1]
Material "diffuse" "rgb reflectance" [.5 .5 .5] ReverseOrientation Shape "sphere" "float radius" 4
)";
    for (std::string integrator : integrators(500)) {
      for (const char* narrow : {"radius\" .2", "radius\" .14"})
        if (const auto radius = integrator.find(narrow); radius != std::string::npos && has_photons(integrator))
          integrator.replace(radius, std::string(narrow).size(), "radius\" .5");
      const Rgb seen =
          mean_of(looking(integrator, homogeneous("fog", params), sphere, "fog"), iterations(integrator, 12, 100));
      expect_colour(seen, 2, 2, 2, has_photons(integrator) ? 0.1 : 0.04);
    }
  }
}

// Densities of 1 and 3, linear in between and towards 0 beyond the ends.
TEST(Media, AbsorbByTheIntegralOfTheirDensity) {
  const std::string smoke = R"(MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nz" 2 "float density" [1 3]
  "point3 p0" [-1 -1 -1] "rgb sigma_a" [.3 .3 .6] "rgb sigma_s" [0 0 0]
)";
  // From z = -1 on, at 0, 1/4, 3/4 and 1 of the box: 1/2, 1, 3, 3/2.
  const double depth = 2 * (0.25 * (0.5 + 1) / 2 + 0.5 * (1 + 3) / 2 + 0.25 * (3 + 1.5) / 2);
  for (const std::string& integrator : integrators(8))
    expect_colour(mean_of(looking(integrator, smoke, kSky + ball_of("smoke")), has_photons(integrator) ? 100 : 600),
                  std::exp(-0.3 * depth), std::exp(-0.3 * depth), std::exp(-0.6 * depth), 0.012);
}

// Inside of a ball in fog there is none: the interface says so.
TEST(Media, EndWhereTheInterfaceSays) {
  const std::string fog = homogeneous("fog", R"("rgb sigma_a" [.2 .2 .2] "rgb sigma_s" [0 0 0])");
  const std::string end =
      R"(AttributeBegin MediumInterface "fog" "" Material "interface" Shape "sphere" "float radius" 4 AttributeEnd
)";
  const double left = std::exp(-0.2 * (7 - 2));
  for (const std::string& integrator : integrators(8))
    expect_colour(
        mean_of(looking(integrator, fog, kSky + ball_of("", "fog") + end, "fog"), has_photons(integrator) ? 2 : 600),
        left, left, left, 0.012);
}

const std::string kFrames = R"(
DynamicBegin "drifting"
  Keyframe 1 Translate -.5 0 0
  Keyframe 4 Translate .5 0 0 KeyframeEnd
  AttributeBegin MediumInterface "smoke" "" Material "interface" Shape "sphere" "float radius" .8 AttributeEnd
DynamicEnd
Material "diffuse" "rgb reflectance" [.7 .7 .7]
Translate 0 0 2 Shape "disk" "float radius" 5
LightSource "point" "rgb I" [20 20 20] "point3 from" [1 2 -1]
)";
std::string drifting(const std::string& integrator, const std::string& density) {
  const std::string wide = R"(LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 50
)";
  std::string text = looking(integrator, smoke(density), kFrames, "", "Frames 4");
  const std::size_t camera = text.find("LookAt"), world = text.find("WorldBegin");
  return text.replace(camera, world - camera, wide);
}

// Frames together are what each is alone: when the boundary moves, and when density and colour change.
TEST(Media, OfFramesTogetherAreAsOfEachAlone) {
  for (const char* density : {"", R"("float scale@1" 1 "float scale@4" 2)",
                              R"("rgb sigma_s@1" [1 1 1] "rgb sigma_s@4" [.2 .6 1])", R"("rgb Le" [2 1 1])"}) {
    for (const char* integrator : {R"("path" "integer maxdepth" 6)", R"("dsppm" "integer photons" 3000)",
                                   R"("dsppm" "integer photons" 3000 "string estimator" "hj09")",
                                   R"("photonmap" "integer photons" 3000 "integer causticphotons" 1000)",
                                   R"("vcm" "integer photons" 500 "integer maxdepth" 6 "float radius" .05)"}) {
      TestScene test(drifting(integrator, density));
      const auto scene = test.scene(test.all_frames());
      const auto together = test.integrator(*scene);
      for (int i = 0; i < 3; ++i) together->iterate({i, *scene});
      for (Frame f = 0; f < 4; ++f)
        EXPECT_LE(max_difference(together->estimate(f), test.render(FileFrame(f), 3)), 1e-4)
            << integrator << density << ", frame " << f + 1;
      EXPECT_GT(max_difference(together->estimate(0), together->estimate(3)), 1e-2) << integrator << density;
    }
  }
}

TEST(Media, KeepThePromises) {
  for (const char* integrator :
       {R"("path" "integer maxdepth" 6)", R"("dsppm" "integer photons" 3000)", R"("sppm" "integer photons" 3000)",
        R"("vcm" "integer photons" 500 "integer maxdepth" 6 "float radius" .05)"}) {
    const std::string text = drifting(integrator, R"("float scale@1" 1 "float scale@4" 2)");
    for (const test::Verdict& verdict :
         {test::check_threads(text, 2), test::check_resume(text, 4), test::check_crop(text, 2)})
      EXPECT_TRUE(verdict.passed) << integrator << verdict.message;
  }
}

// What lamps send out is absorbed, escapes or ends, in expectation also where colours are weighted.
TEST(Media, LoseNoEnergy) {
  for (const char* sigma_s : {"[2 2 2]", "[.2 1 3]"}) {
    TestScene test(drifting(R"("dsppm" "integer photons" 20000 "integer maxdepth" 50)",
                            fmt::format("\"rgb sigma_s\" {}", sigma_s)));
    const auto scene = test.scene(test.all_frames());
    const auto integrator = test.integrator(*scene);
    integrator->iterate({0, *scene});
    for (const EnergyBalance& e : integrator->statistics().energy) {
      ASSERT_GT(e.emitted, 0);
      EXPECT_NEAR((e.absorbed + e.escaped + e.terminated + e.roulette) / e.emitted, 1, 1e-5) << sigma_s;
      EXPECT_GT(e.absorbed / e.emitted, 0.05) << sigma_s;
    }
  }
}

TEST(Media, AreRefusedByThoseThatSeeNone) {
  const std::string fog = homogeneous("fog", "");
  try {
    TestScene(looking("\"ambientocclusion\"", fog, kSky + ball_of("fog")));
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("sees no media"), std::string::npos) << error.what();
  }
}

TEST(Media, OfUnknownNamesAreErrors) {
  try {
    TestScene(looking(kPath, homogeneous("fog", ""), kSky + ball_of("frog")));
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("there is no medium named \"frog\""), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("\"fog\""), std::string::npos) << error.what();
  }
}

}  // namespace media_test
}  // namespace dspm
