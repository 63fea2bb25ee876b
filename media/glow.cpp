#include "dspm/media/glow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/base/colour/spectral_curve.h"
#include "dspm/base/math/rounded.h"

namespace dspm {
namespace {

constexpr float kColdest = 100, kHottest = 40'000;  // kelvin
constexpr int kSteps = 512;                         // of the table, even in the logarithm

float kelvin_of(int step) {
  return kColdest * rounded::pow(kHottest / kColdest, static_cast<float>(step) / static_cast<float>(kSteps - 1));
}

/// pbrt's film takes the sum of a spectrum's values times the observer's, and a light's radiance has a luminance of 1: what
/// glows has that of the unscaled sum.
Rgb colour_of(float kelvin) {
  const SpectralCurve spectrum = blackbody(kelvin);
  return to_rgb(spectrum, SpectrumRole::illuminant) * static_cast<float>(to_xyz(spectrum)[1]);
}

const std::array<Rgb, kSteps>& table() {
  static const std::array<Rgb, kSteps> colours = [] {
    std::array<Rgb, kSteps> all;
    for (int i = 0; i < kSteps; ++i) all[static_cast<std::size_t>(i)] = colour_of(kelvin_of(i));
    return all;
  }();
  return colours;
}

}  // namespace

Glow::Glow(ParamReader& reader)
    : offset_(reader.number("temperatureoffset", 0, "kelvin", "subtracted from the temperature")),
      scale_(reader.number("temperaturescale", 1, "", "multiplies what is left")) {}

Rgb Glow::at(float temperature) const {
  const float kelvin = (temperature - offset_) * scale_;
  if (!(kelvin > kColdest)) return {};
  const float place = rounded::log(std::min(kelvin, kHottest) / kColdest) / rounded::log(kHottest / kColdest) *
                      static_cast<float>(kSteps - 1);
  const int below = std::min(static_cast<int>(place), kSteps - 2);
  const float rest = place - static_cast<float>(below);
  const auto& colours = table();
  return (colours[static_cast<std::size_t>(below)] * (1 - rest) + colours[static_cast<std::size_t>(below) + 1] * rest) *
         factor_;
}

}  // namespace dspm
