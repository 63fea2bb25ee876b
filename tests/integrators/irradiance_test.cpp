// What each kind of light gives a floor, by every integrator: all of it is known in closed form.
#include <gtest/gtest.h>

#include <array>

#include "tests/integrators/floor.h"
#include "tests/integrators/references.h"

namespace dspm::test {
namespace irradiance_test {

constexpr int kMany = 20'000;  // where few photons reach what the camera sees

// E = I cos / d^2, and cos = h / d.
TEST(Irradiance, Point) {
  expect_irradiance({.world = R"(LightSource "point" "rgb I" [5 5 5] "point3 from" [.3 -.2 1])", .photons = kMany},
                    [](double x, double y) {
                      const double d = std::hypot(x - 0.3, y + 0.2, 1);
                      return 5 / (d * d * d);
                    });
}

// As a point, times 3 t^2 - 2 t^3 where the cosine is the share t of the way from the rim's, at 40 degrees, to that of
// 20 degrees, where the falloff begins.
TEST(Irradiance, Spot) {
  const double rim = std::cos(40 * kPiExactly / 180), full = std::cos(20 * kPiExactly / 180);
  expect_irradiance({R"(
LightSource "spot" "rgb I" [5 5 5] "point3 from" [0 0 1.4] "point3 to" [0 0 0] "float coneangle" 40
  "float conedeltaangle" 20)"},
                    [&](double x, double y) {
                      const double d = std::hypot(x, y, 1.4), t = std::clamp((1.4 / d - rim) / (full - rim), 0., 1.);
                      return 5 * 1.4 / (d * d * d) * t * t * (3 - 2 * t);
                    });
}

// L is what a face across the light receives; the floor receives L cos.
TEST(Irradiance, Distant) {
  expect_irradiance(
      {.world = R"(LightSource "distant" "rgb L" [2 2 2] "point3 from" [1 2 3] "point3 to" [0 0 0])", .photons = kMany},
      [](double, double) { return 2 * 3 / std::sqrt(14); });
}

// A sun's disk is its own image turned by the same angle: in the open, the floor receives as much as without an angle.
TEST(Irradiance, SoftSun) {
  expect_irradiance({.world = R"(
LightSource "distant" "rgb L" [2 2 2] "point3 from" [1 2 3] "point3 to" [0 0 0] "float angle" 40)",
                     .photons = kMany},
                    [](double, double) { return 2 * 3 / std::sqrt(14); });
}

// Behind an edge at x = 0 and the height h, a direction is open if w_x / w_z > -x / h. By the cosine, directions count
// as much as their projection onto the floor, where the disk is one of radius sin a, and the edge an ellipse,
// w_x^2 = (1 - w_y^2) t^2 / (1 + t^2), t = -x / h. The shadow's edge is 2 h tan a wide.
TEST(Irradiance, SoftSunBehindAnEdge) {
  constexpr double kHeight = 0.7, kHalfAngle = kPiExactly / 6;
  expect_irradiance({.world = R"(
LightSource "distant" "rgb L" [2 2 2] "point3 from" [0 0 1] "point3 to" [0 0 0] "float angle" 60
Material "diffuse" "rgb reflectance" [0 0 0]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-2 -2 .7 0 -2 .7 0 2 .7 -2 2 .7])",
                     .photons = kMany},
                    [](double x, double) {
                      constexpr int kRows = 100;
                      const double t = -x / kHeight, sine = std::sin(kHalfAngle);
                      double open = 0;
                      for (int i = 0; i < kRows; ++i) {
                        const double y = sine * ((i + 0.5) / kRows * 2 - 1), end = std::sqrt(sine * sine - y * y);
                        open += end - std::clamp(t * std::sqrt((1 - y * y) / (1 + t * t)), -end, end);
                      }
                      return 2 / (kPiExactly * sine * sine) * open * 2 * sine / kRows;
                    });
}

// The integral of cos over the hemisphere is pi.
TEST(Irradiance, Infinite) {
  expect_irradiance({.world = R"(LightSource "infinite" "rgb L" [2 2 2])", .photons = kMany},
                    [](double, double) { return 2 * kPiExactly; });
}

// A pixel of a picture of latitude and longitude, between two angles from the zenith and of the width w in longitude,
// has the integral of cos, w (sin^2 b - sin^2 a) / 2.
TEST(Irradiance, PictureOfTheSky) {
  const std::filesystem::path file = kReferenceFolder / "sky.png";
  const Image sky = read_image(file);
  std::array<double, 3> expected{};
  for (int row = 0; row < sky.height / 2; ++row)
    for (int column = 0; column < sky.width; ++column) {
      const double a = std::sin(row * kPiExactly / sky.height), b = std::sin((row + 1) * kPiExactly / sky.height);
      for (int c = 0; c < 3; ++c)
        expected[static_cast<std::size_t>(c)] +=
            static_cast<double>(sky.at(column, row)[c]) * 2 * kPiExactly / sky.width * (b * b - a * a) / 2;
    }
  const Floor floor{fmt::format(R"(LightSource "infinite" "string filename" "{}" "string mapping" "equirectangular")",
                                file.string())};
  Image picture = floor_picture(floor, [](double, double) { return 1; });
  for (Rgb& pixel : picture.pixels)
    for (int c = 0; c < 3; ++c) pixel[c] *= static_cast<float>(expected[static_cast<std::size_t>(c)]);
  expect_picture(floor, picture);
}

// E = pi L times the form factor.
TEST(Irradiance, Disk) {
  expect_irradiance(
      {R"(
AreaLightSource "diffuse" "rgb L" [4 4 4]
Material "diffuse" "rgb reflectance" [0 0 0]
Translate .2 -.1 .9
Rotate 180 1 0 0
Shape "disk" "float radius" .5)"},
      [](double x, double y) { return 4 * kPiExactly * disk_form_factor(std::hypot(x - 0.2, y + 0.1), 0.9, 0.5); });
}

// From outside a sphere that glows is a point: I = L pi R^2.
TEST(Irradiance, Sphere) {
  expect_irradiance({.world = R"(
AreaLightSource "diffuse" "rgb L" [4 4 4]
Material "diffuse" "rgb reflectance" [0 0 0]
Translate .2 -.1 .8
Shape "sphere" "float radius" .3)",
                     .photons = kMany},
                    [](double x, double y) {
                      const double d = std::hypot(x - 0.2, y + 0.1, 0.8);
                      return 4 * kPiExactly * 0.3 * 0.3 * 0.8 / (d * d * d);
                    });
}

// [Lambert 1760]: a polygon's E is L / 2 times the sum over its edges of the angle that the edge spans, times the cosine
// between the floor's normal and that of the plane through the edge and the point.
TEST(Irradiance, TiltedRectangle) {
  using Point = std::array<double, 3>;
  const std::array<Point, 4> corners{{{-.5, -.3, .7}, {.5, -.3, 1.1}, {.5, .3, 1.1}, {-.5, .3, .7}}};
  expect_irradiance(
      {R"(
AreaLightSource "diffuse" "rgb L" [4 4 4] "bool twosided" true
Material "diffuse" "rgb reflectance" [0 0 0]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-.5 -.3 .7 .5 -.3 1.1 .5 .3 1.1 -.5 .3 .7])"},
      [&](double x, double y) {
        double sum = 0;
        for (std::size_t i = 0; i < 4; ++i) {
          const Point a{corners[i][0] - x, corners[i][1] - y, corners[i][2]};
          const Point b{corners[(i + 1) % 4][0] - x, corners[(i + 1) % 4][1] - y, corners[(i + 1) % 4][2]};
          const Point cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
          const double sine = std::hypot(cross[0], cross[1], cross[2]);
          sum += std::atan2(sine, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * cross[2] / sine;
        }
        return 4 * std::abs(sum) / 2;
      });
}

// A black ball takes from the sky what a glowing one of its radiance would give, and so does a black disk.
TEST(Irradiance, SkyBehindABall) {
  expect_irradiance({R"(
LightSource "infinite" "rgb L" [1 1 1]
Material "diffuse" "rgb reflectance" [0 0 0]
Translate 0 0 .7
Shape "sphere" "float radius" .5)"},
                    [](double x, double y) {
                      const double d = std::hypot(x, y, 0.7);
                      return kPiExactly * (1 - 0.5 * 0.5 * 0.7 / (d * d * d));
                    });
}
TEST(Irradiance, SkyBehindADisk) {
  expect_irradiance({R"(
LightSource "infinite" "rgb L" [1 1 1]
Material "diffuse" "rgb reflectance" [0 0 0]
Translate 0 0 .6
Shape "disk" "float radius" .6)"},
                    [](double x, double y) { return kPiExactly * (1 - disk_form_factor(std::hypot(x, y), 0.6, 0.6)); });
}

}  // namespace irradiance_test
}  // namespace dspm::test
