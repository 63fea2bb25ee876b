// Xyz over 360 to 830 nm in steps of 1 nm with the CIE 1931 observer, as all conversions of spectra take them.
#pragma once

#include <algorithm>
#include <array>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectral_curve.h"
#include "dspm/base/colour/spectrum_tables.h"

namespace dspm {

inline constexpr int kObserverStep = 5;

struct Xyz {
  double x = 0, y = 0, z = 0;
};

/// The observer at a whole number of nm.
inline Xyz observer(int nm) {
  const int i = std::min((nm - kFirstNm) / kObserverStep, kObserverSamples - 2);
  const double t = static_cast<double>(nm - kFirstNm - i * kObserverStep) / kObserverStep;
  const auto lerp = [&](const std::array<float, kObserverSamples>& table) {
    const std::size_t k = static_cast<std::size_t>(i);
    return table[k] + t * (static_cast<double>(table[k + 1]) - static_cast<double>(table[k]));
  };
  return {lerp(kObserverX), lerp(kObserverY), lerp(kObserverZ)};
}

template <class Value>
Xyz integrate(Value&& value) {
  Xyz sums;
  for (int nm = kFirstNm; nm <= kLastNm; ++nm) {
    const Xyz o = observer(nm);
    const double v = value(nm);
    sums.x += o.x * v, sums.y += o.y * v, sums.z += o.z * v;
  }
  return sums;
}

/// Converts CIE XYZ to linear RGB with the primaries and white point of ITU-R BT.709.
inline std::array<double, 3> rec709(const Xyz& c) {
  return {3.240479 * c.x - 1.537150 * c.y - 0.498535 * c.z, -0.969256 * c.x + 1.875991 * c.y + 0.041556 * c.z,
          0.055648 * c.x - 0.204043 * c.y + 1.057311 * c.z};
}

/// Returns the colour under D65, relative to white, of something that transmits value(nm). A constant stays the same.
/// Averaging eta and k with these weights, negative lobes included, gives the reflectance of silver, aluminium, copper
/// and brass within 0.02 of the spectral one, of gold (whose red lies outside Rec. 709) within 0.05; non-negative
/// weights are two to ten times worse.
template <class Value>
std::array<double, 3> under_daylight(Value&& value) {
  static const SpectralCurve daylight = *named_spectrum("stdillum-D65");
  static const auto white = rec709(integrate([](int nm) { return daylight.at(static_cast<float>(nm)); }));
  auto rgb = rec709(integrate([&](int nm) { return value(nm) * daylight.at(static_cast<float>(nm)); }));
  for (std::size_t i = 0; i < 3; ++i) rgb[i] /= white[i];
  return rgb;
}

inline Rgb clamped(const std::array<double, 3>& rgb, double high) {
  const auto channel = [&](std::size_t i) { return static_cast<float>(std::clamp(rgb[i], 0., high)); };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace dspm
