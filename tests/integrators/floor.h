// A floor whose irradiance E is known, seen straight down by parallel rays: the radiance is reflectance / pi * E, so
// dark a reflectance that what is scattered twice does not count.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "dspm/base/math/moments.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/test_scene.h"
#include "tests/support/seeds.h"

namespace dspm::test {

inline constexpr double kPiExactly = std::numbers::pi;
inline constexpr double kFloorReflectance = 0.02;
inline constexpr int kFloorSide = 16;  // pixels

struct Floor {
  std::string world;     // above z = 0.1, where the camera is
  double half = 1;       // what the camera sees: |x|, |y| < half
  float radius = 0.04f;  // of gathers: small against what E changes over
  int max_depth = 8;
  double bias = 0.003;   // of the gathers' blur
  int photons = 10'000;  // an iteration

  std::string text(const std::string& integrator) const {
    return fmt::format(R"(
Integrator {} "integer maxdepth" {}
LookAt 0 0 0.1  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-{half} {half} -{half} {half}]
PixelFilter "box"
Film "rgb" "integer xresolution" {side} "integer yresolution" {side}
WorldBegin
Material "diffuse" "rgb reflectance" [{r} {r} {r}]
Shape "disk" "float radius" {all}
)",
                       integrator, max_depth, fmt::arg("half", half), fmt::arg("side", kFloorSide),
                       fmt::arg("r", kFloorReflectance), fmt::arg("all", 1.5 * half + 0.1)) +
           world;
  }
};

/// The radiance of each pixel where E is known at each point.
using Irradiance = std::function<double(double x, double y)>;
inline Image floor_picture(const Floor& floor, const Irradiance& irradiance) {
  constexpr int kGrid = 4;  // points of a pixel, along each side
  const TestScene test(floor.text("\"path\""));
  const auto scene = test.scene({FileFrame(0)});
  Image image(kFloorSide, kFloorSide);
  for (int y = 0; y < kFloorSide * kGrid; ++y)
    for (int x = 0; x < kFloorSide * kGrid; ++x) {
      const Vec2 film{(static_cast<float>(x) + 0.5f) / kGrid, (static_cast<float>(y) + 0.5f) / kGrid};
      const Vec3 p = scene->camera.states.at(0).object->ray(film, {0.5f, 0.5f}).origin;
      const double e = irradiance(static_cast<double>(p.x), static_cast<double>(p.y));
      image.at(x / kGrid, y / kGrid) += Rgb(static_cast<float>(kFloorReflectance / kPiExactly * e / (kGrid * kGrid)));
    }
  return image;
}

/// How an integrator is asked for, with places for the radius of its gathers and the number of photons.
struct FloorIntegrator {
  const char* words;
  int iterations;
};
inline constexpr FloorIntegrator kFloorIntegrators[] = {
    {R"("path")", 12},
    {R"("sppm" "integer photons" {1} "string estimator" "hj09" "float radius" {0})", 2},
    {R"("dsppm" "integer photons" {1} "string estimator" "hj09" "float radius" {0})", 2},
    {R"("dsppm" "integer photons" {1} "string estimator" "kz11" "float radius" {0})", 2},
    {R"("dsppm" "integer photons" {1} "string estimator" "hj09" "string direct" "photons" "float radius" {0})", 2},
    {R"("dsppm" "integer photons" {1} "string estimator" "kz11" "string direct" "photons" "float radius" {0})", 2},
    {R"("dsppm" "integer photons" {1} "string estimator" "hj09" "string direct" "sampled" "float radius" {0})", 2},
    {R"("dsppm" "integer photons" {1} "string estimator" "kz11" "string direct" "sampled" "float radius" {0})", 2},
    {R"("photonmap" "integer photons" 1000 "integer causticphotons" {1} "float causticradius" {0})", 1},
    {R"("vcm" "integer photons" {1} "float radius" {0})", 2},
};

enum class By { all, photons };  // photons alone find points and directions by way of glass and mirrors

inline void expect_picture(const Floor& floor, const Image& expected, By by = By::all) {
  constexpr int kComparisons = 200;  // all of them together fail right integrators with a chance of 1%
  constexpr int kQuarters = 2;       // many seeds and few figures make a sharp t-test
  const Tiles exact = tiles_of({{expected}}, kQuarters);
  for (const FloorIntegrator& integrator : kFloorIntegrators) {
    if (by == By::photons && std::string_view(integrator.words) == R"("path")") continue;
    const std::string words = fmt::format(fmt::runtime(integrator.words), floor.radius, floor.photons);
    const Verdict verdict = agreement(rendered(floor.text(words), integrator.iterations, seeds(16), kQuarters), exact,
                                      {0.01 / kComparisons, floor.bias});
    EXPECT_TRUE(verdict.passed) << words << ": " << verdict.message;
  }
}

inline void expect_irradiance(const Floor& floor, const Irradiance& irradiance, By by = By::all) {
  expect_picture(floor, floor_picture(floor, irradiance), by);
}

/// The share of the light of a small horizontal face that a horizontal disk of radius a, h above and d beside it, takes
/// away or gives. [Foote 1915]
inline double disk_form_factor(double d, double h, double a) {
  const double sum = h * h + d * d + a * a;
  return (1 - (h * h + d * d - a * a) / std::sqrt(sum * sum - 4 * a * a * d * d)) / 2;
}

/// Unpolarised, for light that arrives at an angle of that cosine from outside. [Fresnel 1823]
inline double fresnel(double cosine, double index) {
  const double beyond = std::sqrt(1 - (1 - cosine * cosine) / (index * index));
  const double parallel = (index * cosine - beyond) / (index * cosine + beyond);
  const double perpendicular = (cosine - index * beyond) / (cosine + index * beyond);
  return (parallel * parallel + perpendicular * perpendicular) / 2;
}

}  // namespace dspm::test
