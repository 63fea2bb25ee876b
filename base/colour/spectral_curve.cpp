#include "dspm/base/colour/spectral_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dspm/base/colour/observer.h"

namespace dspm {
namespace {

Rgb illuminant(const SpectralCurve& spectrum) {
  const Xyz sums = integrate([&](int nm) { return spectrum.at(static_cast<float>(nm)); });
  if (!(sums.y > 0)) return {};
  const Rgb inside = clamped(rec709({sums.x / sums.y, 1, sums.z / sums.y}), std::numeric_limits<float>::max());
  return inside / luminance(inside);
}

}  // namespace

float SpectralCurve::at(float wavelength) const {
  if (nm.empty() || wavelength < nm.front() || wavelength > nm.back()) return 0;
  const auto above = std::upper_bound(nm.begin(), nm.end(), wavelength);
  if (above == nm.end()) return values.back();
  const std::size_t i = static_cast<std::size_t>(above - nm.begin());
  return std::lerp(values[i - 1], values[i], (wavelength - nm[i - 1]) / (nm[i] - nm[i - 1]));
}

std::array<double, 3> to_xyz(const SpectralCurve& spectrum) {
  const Xyz sums = integrate([&](int nm) { return spectrum.at(static_cast<float>(nm)); });
  return {sums.x, sums.y, sums.z};
}

Rgb to_rgb(const SpectralCurve& spectrum, SpectrumRole role) {
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
