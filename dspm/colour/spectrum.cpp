// Spectrum to RGB: sums over 360 to 830 nm in steps of 1 nm with the CIE 1931 observer.
#include "dspm/colour/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dspm/colour/spectrum_tables.h"

namespace dspm {
namespace {

constexpr int kFirstNm = 360, kLastNm = 830, kObserverStep = 5;

struct Sums {
  double x = 0, y = 0, z = 0;
};

/// The observer at a whole number of nm.
Sums observer(int nm) {
  const int i = std::min((nm - kFirstNm) / kObserverStep, kObserverSamples - 2);
  const double t = static_cast<double>(nm - kFirstNm - i * kObserverStep) / kObserverStep;
  const auto lerp = [&](const std::array<float, kObserverSamples>& table) {
    const std::size_t k = static_cast<std::size_t>(i);
    return table[k] + t * (static_cast<double>(table[k + 1]) - static_cast<double>(table[k]));
  };
  return {lerp(kObserverX), lerp(kObserverY), lerp(kObserverZ)};
}

template <class Function>
auto at_each_nm(Function&& function) {
  std::array<decltype(function(kFirstNm)), kLastNm - kFirstNm + 1> values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = function(kFirstNm + static_cast<int>(i));
  return values;
}

template <class Value>
Sums integrate(Value&& value) {
  static const auto observed = at_each_nm(observer);
  Sums sums;
  for (int nm = kFirstNm; nm <= kLastNm; ++nm) {
    const Sums& o = observed[static_cast<std::size_t>(nm - kFirstNm)];
    const double v = value(nm);
    sums.x += o.x * v, sums.y += o.y * v, sums.z += o.z * v;
  }
  return sums;
}

/// CIE XYZ to linear RGB with the primaries and white point of ITU-R BT.709.
std::array<double, 3> rec709(const Sums& c) {
  return {3.240479 * c.x - 1.537150 * c.y - 0.498535 * c.z, -0.969256 * c.x + 1.875991 * c.y + 0.041556 * c.z,
          0.055648 * c.x - 0.204043 * c.y + 1.057311 * c.z};
}

/// The colour under D65, relative to white, of something that transmits value(nm). A constant stays the same. Averaging
/// eta and k with these weights, negative lobes included, gives the reflectance of silver, aluminium, copper and brass
/// within 0.02 of the spectral one, of gold (whose red lies outside Rec. 709) within 0.05; non-negative weights are two
/// to ten times worse.
template <class Value>
std::array<double, 3> under_daylight(Value&& value) {
  static const auto spectrum =
      at_each_nm([d65 = *named_spectrum("stdillum-D65")](int nm) { return d65.at(static_cast<float>(nm)); });
  constexpr auto daylight = [](int nm) { return spectrum[static_cast<std::size_t>(nm - kFirstNm)]; };
  static const auto white = rec709(integrate(daylight));
  auto rgb = rec709(integrate([&](int nm) { return value(nm) * daylight(nm); }));
  for (std::size_t i = 0; i < 3; ++i) rgb[i] /= white[i];
  return rgb;
}

Rgb clamped(const std::array<double, 3>& rgb, double high) {
  const auto channel = [&](std::size_t i) { return static_cast<float>(std::clamp(rgb[i], 0., high)); };
  return {channel(0), channel(1), channel(2)};
}

Rgb illuminant(const Spectrum& spectrum) {
  const Sums sums = integrate([&](int nm) { return spectrum.at(static_cast<float>(nm)); });
  if (!(sums.y > 0)) return {};
  const Rgb inside = clamped(rec709({sums.x / sums.y, 1, sums.z / sums.y}), std::numeric_limits<float>::max());
  return inside / luminance(inside);
}

}  // namespace

float Spectrum::at(float wavelength) const {
  if (nm.empty() || wavelength < nm.front() || wavelength > nm.back()) return 0;
  const auto above = std::upper_bound(nm.begin(), nm.end(), wavelength);
  if (above == nm.end()) return values.back();
  const std::size_t i = static_cast<std::size_t>(above - nm.begin());
  return std::lerp(values[i - 1], values[i], (wavelength - nm[i - 1]) / (nm[i] - nm[i - 1]));
}

std::array<double, 3> to_xyz(const Spectrum& spectrum) {
  const Sums sums = integrate([&](int nm) { return spectrum.at(static_cast<float>(nm)); });
  return {sums.x, sums.y, sums.z};
}

Rgb to_rgb(const Spectrum& spectrum, SpectrumRole role) {
  if (spectrum.nm.empty()) return {};
  switch (role) {
    case SpectrumRole::albedo:
      return clamped(under_daylight([&](int nm) { return spectrum.at(static_cast<float>(nm)); }), 1);
    case SpectrumRole::unbounded:
      return clamped(under_daylight([&](int nm) {
                       return spectrum.at(std::clamp(static_cast<float>(nm), spectrum.nm.front(), spectrum.nm.back()));
                     }),
                     std::numeric_limits<float>::max());
    case SpectrumRole::illuminant: return illuminant(spectrum);
  }
  return {};
}

}  // namespace dspm
