// Offsets must follow the filters' formulas: chi-square tests at a stated level with fixed seeds, and exact quantiles.
#include "dspm/image/film/pixel_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "dspm/base/math/rng.h"
#include "dspm/testing/chi2.h"

namespace dspm {
namespace {

constexpr double kLevel = 0.01 / 20;  // about 20 tests in this file

std::unique_ptr<PixelFilter> make(const std::string& name, const std::vector<std::pair<std::string, float>>& values,
                                  Diagnostics& diagnostics) {
  ParamList list;
  for (const auto& [key, value] : values) {
    Param param;
    param.name = key, param.values = std::vector<float>{value};
    list.params.push_back(param);
  }
  const auto* plugin = pixel_filter_plugins().find(name, {}, diagnostics);
  if (plugin == nullptr) return nullptr;
  ParamReader reader(list, "pixel filter \"" + name + "\"", {}, diagnostics);
  return plugin->make(reader);
}

std::unique_ptr<PixelFilter> make(const std::string& name,
                                  const std::vector<std::pair<std::string, float>>& values = {}) {
  Diagnostics diagnostics;
  auto filter = make(name, values, diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 0);
  return filter;
}

/// The integral of `density` over [a, b], by Simpson's rule in many steps.
double integral(const std::function<double(double)>& density, double a, double b) {
  constexpr int kSteps = 64;
  double sum = density(a) + density(b);
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4 : 2) * density(a + (b - a) * i / kSteps);
  return sum * (b - a) / kSteps / 3;
}

/// One axis of the filter against its formula (not normalised) on [-radius, radius].
double p_value(const std::vector<float>& offsets, double radius, const std::function<double(double)>& formula) {
  constexpr int kCells = 60;
  std::vector<int> observed(kCells);
  for (const float offset : offsets) {
    EXPECT_LE(std::abs(offset), radius);
    ++observed[static_cast<std::size_t>(std::min((offset / radius + 1) / 2 * kCells, kCells - 1.0))];
  }
  double chi2 = 0, whole = 0;
  std::vector<double> mass;
  for (int i = 0; i < kCells; ++i) {
    const auto edge = [&](int k) { return radius * (2.0 * k / kCells - 1); };
    mass.push_back(integral(formula, edge(i), edge(i + 1)));
    whole += mass.back();
  }
  for (std::size_t i = 0; i < kCells; ++i) {
    const double expected = mass[i] / whole * static_cast<double>(offsets.size());
    EXPECT_GT(expected, 5);
    chi2 += (observed[i] - expected) * (observed[i] - expected) / expected;
  }
  return test::chi2_tail(chi2, kCells - 1);
}

void expect_profiles(const PixelFilter& filter, Vec2 radius, const std::function<double(double)>& in_x,
                     const std::function<double(double)>& in_y) {
  std::vector<float> x, y;
  for (std::uint64_t i = 0; i < 1'000'000; ++i) {
    const Vec2 offset = filter.sample(PathRandom(3, Stream::camera, i, 0).pair(0, 0));
    x.push_back(offset.x), y.push_back(offset.y);
  }
  EXPECT_GT(p_value(x, static_cast<double>(radius.x), in_x), kLevel);
  EXPECT_GT(p_value(y, static_cast<double>(radius.y), in_y), kLevel);
}

TEST(PixelFilter, Box) {
  const auto flat = [](double) { return 1.0; };
  expect_profiles(*make("box"), {0.5f, 0.5f}, flat, flat);
  expect_profiles(*make("box", {{"xradius", 2}, {"yradius", 0.25f}}), {2, 0.25f}, flat, flat);
  EXPECT_EQ(make("box")->sample({0, 0.5f}), (Vec2{-0.5f, 0}));
}

TEST(PixelFilter, Triangle) {
  const auto tent = [](double radius) { return [radius](double x) { return radius - std::abs(x); }; };
  expect_profiles(*make("triangle"), {2, 2}, tent(2), tent(2));
  expect_profiles(*make("triangle", {{"xradius", 1}, {"yradius", 3}}), {1, 3}, tent(1), tent(3));
}

TEST(PixelFilter, TriangleQuantilesAreExact) {
  // Below the centre the mass up to x is (1 + x / r)^2 / 2.
  const auto filter = make("triangle");
  for (int i = 0; i < 1000; ++i) {
    const float u = static_cast<float>(i) / 2000;
    EXPECT_NEAR(filter->sample({u, 0}).x, 2 * (std::sqrt(2 * u) - 1), 1e-6);
    EXPECT_NEAR(filter->sample({1 - u, 0}).x, -2 * (std::sqrt(2 * u) - 1), u < 1e-3f ? 1e-3 : 1e-5);
  }
}

TEST(PixelFilter, Gaussian) {
  const auto lowered = [](double radius, double sigma) {
    const auto gauss = [sigma](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
    return [=](double x) { return gauss(x) - gauss(radius); };
  };
  expect_profiles(*make("gaussian"), {1.5f, 1.5f}, lowered(1.5, 0.5), lowered(1.5, 0.5));
  expect_profiles(*make("gaussian", {{"sigma", 2}, {"yradius", 3}}), {1.5f, 3}, lowered(1.5, 2), lowered(3, 2));
}

TEST(PixelFilter, MitchellIsThePositivePartOfItsSpline) {
  const auto spline = [](double radius, double b, double c) {
    return [=](double offset) {
      const double x = std::abs(2 * offset / radius), x2 = x * x, x3 = x2 * x;
      const double inner = (12 - 9 * b - 6 * c) * x3 + (-18 + 12 * b + 6 * c) * x2 + 6 - 2 * b,
                   outer = (-b - 6 * c) * x3 + (6 * b + 30 * c) * x2 + (-12 * b - 48 * c) * x + 8 * b + 24 * c;
      return std::max(0.0, x < 1 ? inner : outer);
    };
  };
  // B = 1, C = 0 is the cubic B-spline, which has no negative lobes.
  for (const auto& [b, c] : {std::pair(1 / 3.f, 1 / 3.f), {1.f, 0.f}, {0.f, 0.5f}}) {
    const auto formula = spline(3, static_cast<double>(b), static_cast<double>(c));
    const auto filter = make("mitchell", {{"B", b}, {"C", c}, {"xradius", 3}});
    for (int i = -100; i <= 100; ++i) {
      const float x = 0.0299f * static_cast<float>(i);
      EXPECT_NEAR(filter->density({x, 0}) / filter->density({0, 0}), formula(static_cast<double>(x)) / formula(0), 2e-3)
          << x << " " << b;
    }
  }
}

TEST(PixelFilter, SincIsItsPositivePart) {
  const auto filter = make("sinc");
  for (int i = 1; i <= 100; ++i) {
    const double x = 0.0399 * i, windowed = std::sin(std::numbers::pi * x) * std::sin(std::numbers::pi * x / 3) /
                                            (std::numbers::pi * x * std::numbers::pi * x / 3);
    EXPECT_NEAR(filter->density({static_cast<float>(x), 0}) / filter->density({0, 0}), std::max(0.0, windowed), 3e-3)
        << x;
  }
}

TEST(PixelFilter, LobesThatAreLeftOutAreNoted) {
  for (const auto& [name, c, notes] : {std::tuple{"mitchell", 0.3f, 1u}, {"mitchell", 0.f, 0u}}) {
    Diagnostics diagnostics;
    make(name, {{"C", c}}, diagnostics);
    EXPECT_EQ(diagnostics.all().size(), notes);
  }
}

TEST(PixelFilter, DensityIsThatOfTheSamples) {
  for (const char* name : {"box", "triangle", "gaussian"}) {
    const auto filter = make(name, {{"xradius", 1.25f}, {"yradius", 0.75f}});
    const auto in_x = [&](double x) { return static_cast<double>(filter->density({static_cast<float>(x), 0.1f})); };
    const auto in_y = [&](double y) { return static_cast<double>(filter->density({0.2f, static_cast<float>(y)})); };
    expect_profiles(*filter, {1.25f, 0.75f}, in_x, in_y);
    double whole = 0;
    for (int i = 0; i < 100; ++i) {
      const double y = (i + 0.5) / 50 - 1;
      whole += 0.02 * integral(
                          [&](double x) {
                            return static_cast<double>(filter->density({static_cast<float>(x), static_cast<float>(y)}));
                          },
                          -1.5, 1.5);
    }
    EXPECT_NEAR(whole, 1, 0.02) << name;
    EXPECT_EQ(filter->density({1.26f, 0}), 0) << name;
    EXPECT_EQ(filter->density({0, -0.76f}), 0) << name;
  }
}

TEST(PixelFilter, ANarrowGaussianInAWideRadius) {
  const auto filter = make("gaussian", {{"sigma", 0.01f}});
  double variance = 0;
  constexpr int kSamples = 100'000;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const float x = filter->sample(PathRandom(5, Stream::camera, i, 0).pair(0, 0)).x;
    variance += static_cast<double>(x) * x / kSamples;
  }
  // The variance of a sample variance is 2 sigma^4 / n: four of its deviations.
  EXPECT_NEAR(variance, 1e-4, 4 * 1e-4 * std::sqrt(2.0 / kSamples));
}

TEST(PixelFilter, OffsetsRiseWithTheNumber) {
  for (const char* name : {"box", "triangle", "gaussian"}) {
    const auto filter = make(name);
    float last = -filter->radius().x;
    for (int i = 0; i < 1 << 16; ++i) {
      const float x = filter->sample({static_cast<float>(i) / (1 << 16), 0}).x;
      EXPECT_GE(x, last - 1e-6f) << name;
      last = x;
    }
    EXPECT_LE(filter->sample({0x0.ffffffp0f, 0}).x, filter->radius().x);
  }
}

TEST(PixelFilter, BothAxesAreIndependent) {
  const auto filter = make("gaussian");
  std::vector<int> cells(16);
  for (std::uint64_t i = 0; i < 400'000; ++i) {
    const Vec2 offset = filter->sample(PathRandom(9, Stream::camera, i, 0).pair(0, 0));
    // Quartiles of the lowered gaussian, by its own sampling of known numbers.
    const auto quartile = [&](float v) {
      std::size_t q = 0;
      for (const float u : {0.25f, 0.5f, 0.75f}) q += v >= filter->sample({u, 0}).x ? 1u : 0u;
      return q;
    };
    ++cells[4 * quartile(offset.x) + quartile(offset.y)];
  }
  double chi2 = 0;
  for (const int observed : cells) chi2 += (observed - 25'000.0) * (observed - 25'000.0) / 25'000;
  EXPECT_GT(test::chi2_tail(chi2, 15), kLevel);
}

TEST(PixelFilter, WrongOnesAreErrors) {
  const std::vector<std::pair<std::string, std::vector<std::pair<std::string, float>>>> wrong = {
      {"box", {{"xradius", 0}}},    {"triangle", {{"yradius", -1}}},
      {"gaussian", {{"sigma", 0}}}, {"gaussian", {{"alpha", 2}}},
      {"mitchell", {{"B", 3}}},     {"mitchell", {{"C", -1}}},
      {"sinc", {{"tau", 0}}},       {"gauss", {}}};
  for (const auto& [name, values] : wrong) {
    Diagnostics diagnostics;
    make(name, values, diagnostics);
    EXPECT_EQ(diagnostics.error_count(), 1) << name;
  }
}

}  // namespace
}  // namespace dspm
