// What comes to a floor by way of glass and mirrors, where that is known.
#include <gtest/gtest.h>

#include <optional>

#include "tests/integrators/floor.h"

namespace dspm::test {
namespace caustics_test {

constexpr double kIndex = 1.5;

// What a plate reflects between its two faces to and fro passes as well: with R of one face,
//   T = (1 - R)^2 (1 + R^2 + R^4 + ...) = (1 - R) / (1 + R).
double plate_transmittance(double cosine) {
  const double r = fresnel(cosine, kIndex);
  return (1 - r) / (1 + r);
}

// A disk of radius a, h above the floor, is an integral over its points: L T(cos) cos^2 / d^2 dA, cos = h / d.
TEST(Caustics, DiskBehindAPane) {
  constexpr double kRadius = 0.4, kHeight = 0.9;
  expect_irradiance({R"(
AttributeBegin
  Material "thindielectric" "float eta" 1.5
  Translate 0 0 .4
  Shape "disk" "float radius" 3
AttributeEnd
AreaLightSource "diffuse" "rgb L" [4 4 4]
Material "diffuse" "rgb reflectance" [0 0 0]
Translate 0 0 .9
Rotate 180 1 0 0
Shape "disk" "float radius" .4)",
                     0.8},
                    [](double x, double y) {
                      constexpr int kRings = 16, kSectors = 32;
                      double sum = 0;
                      for (int i = 0; i < kRings; ++i)
                        for (int j = 0; j < kSectors; ++j) {  // of equal area
                          const double r = kRadius * std::sqrt((i + 0.5) / kRings);
                          const double phi = 2 * kPiExactly * (j + 0.5) / kSectors;
                          const double d = std::hypot(x - r * std::cos(phi), y - r * std::sin(phi), kHeight);
                          const double cosine = kHeight / d;
                          sum += plate_transmittance(cosine) * cosine * cosine / (d * d);
                        }
                      return 4 * sum * kPiExactly * kRadius * kRadius / (kRings * kSectors);
                    });
}

// Parallel light leaves a plate as it came, only displaced.
TEST(Caustics, SunThroughAPane) {
  expect_irradiance(
      {R"(
LightSource "distant" "rgb L" [2 2 2] "point3 from" [.6 0 .8] "point3 to" [0 0 0]
Material "thindielectric" "float eta" 1.5
Translate 0 0 .3
Shape "disk" "float radius" 1.6)",
       0.6},
      [](double, double) { return 2 * 0.8 * plate_transmittance(0.8); }, By::photons);
}
// A sun that is a disk is found along the camera's paths as well: L T(cos) cos over its cone.
TEST(Caustics, SoftSunThroughAPane) {
  constexpr double kHalfAngle = 25 * kPiExactly / 180;
  expect_irradiance({R"(
LightSource "distant" "rgb L" [2 2 2] "point3 from" [0 0 1] "point3 to" [0 0 0] "float angle" 50
Material "thindielectric" "float eta" 1.5
Translate 0 0 .3
Shape "disk" "float radius" 1.6)",
                     0.6},
                    [](double, double) {
                      constexpr int kRings = 100;  // of equal share in sin^2
                      double sum = 0;
                      for (int i = 0; i < kRings; ++i)
                        sum +=
                            plate_transmittance(std::sqrt(1 - (i + 0.5) / kRings * std::pow(std::sin(kHalfAngle), 2)));
                      return 2 * sum / kRings;
                    });
}
TEST(Caustics, SunThroughAPlateOfGlass) {
  expect_irradiance(
      {R"(
LightSource "distant" "rgb L" [2 2 2] "point3 from" [.6 0 .8] "point3 to" [0 0 0]
Material "dielectric" "float eta" 1.5
Shape "disk" "float radius" 2 "float height" .5
ReverseOrientation
Shape "disk" "float radius" 2 "float height" .3)",
       0.6, 0.04f, 16},
      [](double, double) { return 2 * 0.8 * plate_transmittance(0.8); }, By::photons);
}

// A mirror (0.9999 of whose light it reflects) doubles the lamp.
TEST(Caustics, DiskBesideAMirror) {
  expect_irradiance({R"(
AttributeBegin
  Material "conductor" "rgb reflectance" [1 1 1]
  Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [.9 -4 0 .9 4 0 .9 4 3 .9 -4 3]
AttributeEnd
AreaLightSource "diffuse" "rgb L" [4 4 4]
Material "diffuse" "rgb reflectance" [0 0 0]
Translate .2 0 .8
Rotate 180 1 0 0
Shape "disk" "float radius" .4)",
                     0.8},
                    [](double x, double y) {
                      return 4 * kPiExactly *
                             (disk_form_factor(std::hypot(x - 0.2, y), 0.8, 0.4) +
                              disk_form_factor(std::hypot(x - 1.6, y), 0.8, 0.4));
                    });
}

// Below: a spot at the distance D = 2 above the centre of a ball of radius R = 0.5, whose light all falls on the ball. A
// ray at the angle g from the axis meets the ball at the angle i to its normal, sin i = D sin g / R [law of sines], and
// at the angle a = i - g from the ball's top as seen from its centre. By symmetry it reaches the floor at some distance
// x from the axis (beyond it, where x < 0), and brings what the ball leaves of I 2 pi sin g dg.
constexpr double kDistance = 2, kRadius = 0.5, kIntensity = 10;

struct Landing {
  double x, share;
};

/// The pixels' radiance, by rays at narrow steps of g, each of them all around the axis.
template <class Land>
Image picture_of_rays(const Floor& floor, double widest, Land&& land) {
  constexpr int kSteps = 4000, kTurns = 720;
  const double pixel = 2 * floor.half / kFloorSide, most = 1 - std::cos(widest);
  std::vector<double> flux(static_cast<std::size_t>(kFloorSide * kFloorSide));
  for (int step = 0; step < kSteps; ++step) {
    const auto landing = std::optional<Landing>(land(std::acos(1 - most * (step + 0.5) / kSteps)));
    if (!landing) continue;
    for (int turn = 0; turn < kTurns; ++turn) {
      const double phi = 2 * kPiExactly * (turn + 0.5) / kTurns;
      const double x = std::floor((landing->x * std::cos(phi) + floor.half) / pixel);
      const double y = std::floor((landing->x * std::sin(phi) + floor.half) / pixel);
      if (x < 0 || x >= kFloorSide || y < 0 || y >= kFloorSide) continue;
      flux[static_cast<std::size_t>(y * kFloorSide + x)] +=
          landing->share * kIntensity * 2 * kPiExactly * most / (kSteps * kTurns);
    }
  }
  Image image(kFloorSide, kFloorSide);
  for (std::size_t i = 0; i < flux.size(); ++i)
    image.pixels[i] = Rgb(static_cast<float>(kFloorReflectance / kPiExactly * flux[i] / (pixel * pixel)));
  return image;
}

std::string spot_on_a_ball(const std::string& material, double height, double degrees) {
  return fmt::format(R"(
LightSource "spot" "rgb I" [{0} {0} {0}] "point3 from" [0 0 {1}] "point3 to" [0 0 0] "float coneangle" {2}
  "float conedeltaangle" 0
Material {3}
Translate 0 0 {4}
Shape "sphere" "float radius" {5})",
                     kIntensity, height + kDistance, degrees, material, height, kRadius);
}

// The mirrored ray has the angle 2 a + g with the axis upwards.
TEST(Caustics, MirrorBall) {
  constexpr double kHeight = 0.65, kCone = 14.1;  // degrees
  Floor floor{spot_on_a_ball(R"("conductor" "rgb reflectance" [1 1 1])", kHeight, kCone), 1.6, 0.03f, 2};
  floor.bias = 0.01;
  const Image expected = picture_of_rays(floor, kCone * kPiExactly / 180, [&](double g) -> std::optional<Landing> {
    const double a = std::asin(kDistance * std::sin(g) / kRadius) - g, down = kPiExactly - (2 * a + g);
    if (down >= kPiExactly / 2) return std::nullopt;
    return Landing{kRadius * std::sin(a) + (kHeight + kRadius * std::cos(a)) * std::tan(down), 1};
  });
  expect_picture(floor, expected, By::photons);
}

// Within the ball the ray has the angle b to the normals, sin i = n sin b, and turns by i - b towards the axis at either
// surface. From the ball's bottom it leaves at the angle 2 b - a. Both surfaces reflect the same share R(i); a depth of
// three surfaces holds nothing that was reflected inside.
TEST(Caustics, BallOfGlass) {
  constexpr double kHeight = 0.65, kCone = 9;  // degrees: i is below 39
  Floor floor{spot_on_a_ball(R"("dielectric" "float eta" 1.5)", kHeight, kCone), 0.12, 0.004f, 3};
  floor.bias = 0.01, floor.photons = 3000;
  const Image expected = picture_of_rays(floor, kCone * kPiExactly / 180, [&](double g) {
    const double sine = kDistance * std::sin(g) / kRadius, i = std::asin(sine), b = std::asin(sine / kIndex);
    const double out = 2 * b - (i - g), inwards = 2 * (i - b) - g, through = 1 - fresnel(std::cos(i), kIndex);
    return Landing{kRadius * std::sin(out) - (kHeight - kRadius * std::cos(out)) * std::tan(inwards),
                   through * through};
  });
  expect_picture(floor, expected, By::photons);
}

}  // namespace caustics_test
}  // namespace dspm::test
