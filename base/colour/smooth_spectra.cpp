#include "dspm/base/colour/smooth_spectra.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/colour/spectral_curve.h"
#include "dspm/base/colour/wavelength.h"

namespace dspm {
namespace {

using Three = std::array<double, 3>;

constexpr int kStepNm = 5, kSamples = (kLastNm - kFirstNm) / kStepNm + 1;

double place_of(int nm) { return static_cast<double>(nm - kFirstNm) / (kLastNm - kFirstNm); }

/// What light at each sample, and linearly around it, adds to white.
const std::array<Three, kSamples>& weights() {
  static const auto all = [] {
    std::array<Three, kSamples> sums{};
    for (int nm = kFirstNm; nm <= kLastNm; ++nm) {
      const auto below = static_cast<std::size_t>(std::min((nm - kFirstNm) / kStepNm, kSamples - 2));
      const double t = static_cast<double>(nm - kFirstNm) / kStepNm - static_cast<double>(below);
      const std::array<double, 3> white = part_of_white(nm);
      for (std::size_t c = 0; c < 3; ++c) sums[below][c] += (1 - t) * white[c], sums[below + 1][c] += t * white[c];
    }
    return sums;
  }();
  return all;
}

double parabola(const Three& c, double t) { return (c[0] * t + c[1]) * t + c[2]; }
double sigmoid(double x) { return 0.5 + x / (2 * std::sqrt(1 + x * x)); }

/// The difference to a colour, and its derivatives.
struct Miss {
  Three by;
  std::array<Three, 3> derivatives;  // of each component by each coefficient
  double square() const { return by[0] * by[0] + by[1] * by[1] + by[2] * by[2]; }
};

Miss miss(const Three& coefficients, const Rgb& colour) {
  Miss miss{{-double{colour.r}, -double{colour.g}, -double{colour.b}}, {}};
  for (int i = 0; i < kSamples; ++i) {
    const double t = static_cast<double>(i) / (kSamples - 1), x = parabola(coefficients, t);
    const double root = 1 / std::sqrt(1 + x * x), value = 0.5 + x * root / 2, slope = root * root * root / 2;
    const Three by_coefficient{slope * t * t, slope * t, slope};
    const Three& weight = weights()[static_cast<std::size_t>(i)];
    for (std::size_t c = 0; c < 3; ++c) {
      miss.by[c] += weight[c] * value;
      for (std::size_t k = 0; k < 3; ++k) miss.derivatives[c][k] += weight[c] * by_coefficient[k];
    }
  }
  return miss;
}

/// Solves a system of three equations by Cramer's rule.
Three solved(const std::array<Three, 3>& m, const Three& right) {
  const auto determinant = [](const Three& a, const Three& b, const Three& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) + c[0] * (a[1] * b[2] - a[2] * b[1]);
  };
  const auto column = [&](std::size_t k) { return Three{m[0][k], m[1][k], m[2][k]}; };
  const Three a = column(0), b = column(1), c = column(2);
  const double whole = determinant(a, b, c);
  return {determinant(right, b, c) / whole, determinant(a, right, c) / whole, determinant(a, b, right) / whole};
}

/// Goes to the colour by steps that are damped until they come closer. [Levenberg 1944, Marquardt 1963]
Three fitted(const Rgb& colour, Three at) {
  constexpr double kCloseEnough = 1e-12, kMostDamped = 1e12;
  constexpr int kMostSteps = 200;
  Miss here = miss(at, colour);
  double damping = 1e-3;
  for (int step = 0; step < kMostSteps && here.square() > kCloseEnough && damping < kMostDamped; ++step) {
    std::array<Three, 3> normal{};
    Three right{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        right[i] -= here.derivatives[c][i] * here.by[c];
        for (std::size_t k = 0; k < 3; ++k) normal[i][k] += here.derivatives[c][i] * here.derivatives[c][k];
      }
    for (std::size_t i = 0; i < 3; ++i) normal[i][i] *= 1 + damping;
    const Three change = solved(normal, right);
    const Three next{at[0] + change[0], at[1] + change[1], at[2] + change[2]};
    if (const Miss there = miss(next, colour); there.square() < here.square())
      at = next, here = there, damping /= 10;
    else
      damping *= 10;
  }
  return at;
}

}  // namespace

SmoothSpectrum::SmoothSpectrum(const Rgb& colour, const SmoothSpectrum& begin) {
  if (colour.r == colour.g && colour.g == colour.b) {
    constant_ = colour.r;
    return;
  }
  const double grey = std::clamp(double{begin.constant_}, 0.01, 0.99), x = 2 * grey - 1;
  is_constant_ = false;
  coefficients_ = fitted(colour, begin.is_constant_ ? Three{0, 0, x / std::sqrt(1 - x * x)} : begin.coefficients_);
}

float SmoothSpectrum::at(int nm) const {
  return is_constant_ ? constant_ : static_cast<float>(sigmoid(parabola(coefficients_, place_of(nm))));
}

const SmoothSpectra& SmoothSpectra::all() {
  static const SmoothSpectra spectra;
  return spectra;
}

SmoothSpectra::SmoothSpectra() {
  const auto share = [](int i) { return static_cast<float>(i) / (kSide - 1); };
  // From the greys outward, so that each search begins next to its end.
  for (int r = 0; r < kSide; ++r)
    for (int g = 0; g < kSide; ++g) {
      const auto go = [&](int from, int to, int step) {
        for (int b = from; b != to; b += step) {
          const SmoothSpectrum& near = b != from ? at(r, g, b - step) : SmoothSpectrum(Rgb(share(b)), {});
          grid_[index(r, g, b)] = SmoothSpectrum({share(r), share(g), share(b)}, near);
        }
      };
      const int middle = (r + g) / 2;
      go(middle, kSide, 1), go(middle, -1, -1);
    }
}

std::array<float, 3> SmoothSpectra::shares(int nm) const {
  constexpr int kFull = kSide - 1;
  const float red = at(kFull, 0, 0).at(nm), green = at(0, kFull, 0).at(nm), blue = at(0, 0, kFull).at(nm);
  const float sum = red + green + blue;
  return {red / sum, green / sum, blue / sum};
}

}  // namespace dspm
