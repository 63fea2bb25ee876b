// What a pixel filter makes of a small bright rectangle: each pixel has the share of its filter that lies over it, by
// the filter's formula. One unit of the world is one pixel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/sampling.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace film_point_test {

constexpr int kWidth = 9, kHeight = 7;
// Off the middles and edges of pixels, so that no two neighbours get the same.
constexpr double kLeft = 3.6, kRight = 4.8, kTop = 3.1, kBottom = 3.7;

std::string rectangle(const std::string& integrator, const std::string& filter) {
  return fmt::format(R"(
Integrator {}
{}
Camera "orthographic" "float screenwindow" [0 {} {} 0]
Film "rgb" "integer xresolution" {} "integer yresolution" {}
WorldBegin
AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [{} {} 1 {} {} 1 {} {} 1 {} {} 1]
)",
                     integrator, filter, kWidth, -kHeight, kWidth, kHeight, kLeft, -kTop, kRight, -kTop, kRight,
                     -kBottom, kLeft, -kBottom);
}

/// Integrals of the filters over [-radius, x], not normalised; beyond the radius there is nothing.
double box(double x, double radius) { return std::clamp(x, -radius, radius) + radius; }
double triangle(double x, double radius) {
  const double t = std::clamp(x / radius, -1., 1.);
  return t < 0 ? (1 + t) * (1 + t) / 2 : 1 - (1 - t) * (1 - t) / 2;
}
/// Of exp(-x^2 / (2 sigma^2)) - exp(-radius^2 / (2 sigma^2)).
double gaussian(double x, double radius, double sigma) {
  const double at = std::clamp(x, -radius, radius), width = std::sqrt(2.) * sigma;
  return sigma * std::sqrt(std::acos(-1.) / 2) * (std::erf(at / width) + std::erf(radius / width)) -
         std::exp(-radius * radius / (width * width)) * (at + radius);
}

using Integral = std::function<double(double)>;

/// The share of the filter around the middle of pixel i that lies in [from, to].
double share(const Integral& integral, int i, double from, double to) {
  return (integral(to - i - 0.5) - integral(from - i - 0.5)) / integral(kInfinity);
}

struct Filter {
  std::string directive;
  Integral x, y;
};

const Filter kFilters[] = {
    {R"(PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5)", [](double x) { return box(x, 0.5); },
     [](double y) { return box(y, 0.5); }},
    {R"(PixelFilter "box" "float xradius" 2 "float yradius" 1)", [](double x) { return box(x, 2); },
     [](double y) { return box(y, 1); }},
    {R"(PixelFilter "triangle" "float xradius" 1.5 "float yradius" 2)", [](double x) { return triangle(x, 1.5); },
     [](double y) { return triangle(y, 2); }},
    {R"(PixelFilter "gaussian" "float xradius" 2 "float yradius" 1 "float sigma" 0.6)",
     [](double x) { return gaussian(x, 2, 0.6); }, [](double y) { return gaussian(y, 1, 0.6); }},
    // Where the scene says nothing: a gaussian.
    {"", [](double x) { return gaussian(x, 1.5, 0.5); }, [](double y) { return gaussian(y, 1.5, 0.5); }},
};

class FilmPoint : public testing::TestWithParam<const char*> {};

// Each path sees the rectangle with the chance p of its share, so n of them have the mean p and the deviation
// sqrt(p (1 - p) / n). Allowed are five of them, and one path, as small shares do not follow the normal distribution.
TEST_P(FilmPoint, FollowsTheFilter) {
  constexpr int kPaths = 4096;
  for (const Filter& filter : kFilters) {
    const Image image = TestScene(rectangle(GetParam(), filter.directive)).render(FileFrame(0), kPaths);
    int between = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double p = share(filter.x, x, kLeft, kRight) * share(filter.y, y, kTop, kBottom);
        const double tolerance = 5 * std::sqrt(p * (1 - p) / kPaths) + 1. / kPaths;
        EXPECT_NEAR(static_cast<double>(image.at(x, y).g), p, tolerance)
            << filter.directive << ": pixel " << x << ", " << y;
        between += p > 0;
      }
    EXPECT_GT(between, 1);
  }
}

TEST_P(FilmPoint, IsThePixelsMiddleWithoutJitter) {
  const std::string options = GetParam() + std::string("\nOption \"disablepixeljitter\" true");
  const Image image = TestScene(rectangle(options, R"(PixelFilter "box" "float xradius" 3)")).render(FileFrame(0), 16);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool is_lit = x == 4 && y == 3;  // its middle, 4.5, 3.5, alone lies on the rectangle
      EXPECT_NEAR(image.at(x, y).g, is_lit ? 1 : 0, 1e-6f) << x << ", " << y;
    }
}

INSTANTIATE_TEST_SUITE_P(Integrators, FilmPoint,
                         testing::Values("\"path\"", "\"dsppm\" \"integer photons\" 1",
                                         "\"sppm\" \"integer photons\" 1 \"string estimator\" \"hj09\"",
                                         "\"photonmap\" \"integer photons\" 1 \"integer causticphotons\" 1",
                                         "\"vcm\" \"integer photons\" 100"));

// A disk of radius 0.1 before a lens of radius 0.5 that is focused at infinity: at any pixel the rays are parallel and
// cover the lens, so the share of them that meets the disk is (0.1 / 0.5)^2, wherever in view the disk is.
TEST(LensPoints, CoverTheLens) {
  TestScene test(fmt::format(R"(
Integrator "path"
Camera "perspective" "float fov" {} "float lensradius" 0.5 "float focaldistance" 1e6
Film "rgb" "integer xresolution" 9 "integer yresolution" 9
WorldBegin
AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
Translate 0 0 4
Shape "disk" "float radius" 0.1
)",
                             2 * std::atan(0.25 / 4) * 180 / static_cast<double>(kPi)));
  const Image image = test.render(FileFrame(0), 400);
  double mean = 0;
  for (const Rgb& pixel : image.pixels) mean += static_cast<double>(pixel.g) / static_cast<double>(image.pixels.size());
  EXPECT_NEAR(mean, 0.04, 0.1 * 0.04);  // four standard deviations
}

}  // namespace film_point_test
}  // namespace dspm::test
