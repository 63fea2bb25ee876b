#include "dspm/base/colour/colour.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "dspm/base/colour/observer.h"
#include "dspm/base/colour/smooth_spectra.h"

namespace dspm {

namespace {

/// Lines of lamps are spread over 10 nm, or few iterations would meet them.
float in_ten_nm(const SpectralCurve& curve, int nm) {
  constexpr int kWidth = 5;
  float sum = 0;
  for (int away = 1 - kWidth; away < kWidth; ++away)
    sum += static_cast<float>(kWidth - std::abs(away)) / (kWidth * kWidth) * curve.at(static_cast<float>(nm + away));
  return std::max(sum, 0.f);
}

}  // namespace

SpectrumByNm::SpectrumByNm(const SpectralCurve& curve, SpectrumRole role) {
  const auto value_at = [&](int nm) {
    const float at = static_cast<float>(nm);
    switch (role) {
      case SpectrumRole::albedo: return std::clamp(curve.at(at), 0.f, 1.f);
      case SpectrumRole::unbounded:
        return curve.nm.empty() ? 0 : std::max(0.f, curve.at(std::clamp(at, curve.nm.front(), curve.nm.back())));
      case SpectrumRole::illuminant: return in_ten_nm(curve, nm);
    }
    return 0.f;
  };
  for (int nm = kFirstNm; nm <= kLastNm; ++nm) values_[static_cast<std::size_t>(nm - kFirstNm)] = value_at(nm);
  if (role != SpectrumRole::illuminant) return;
  static const SpectralCurve daylight = *named_spectrum("stdillum-D65");
  static const double daylight_luminance = to_xyz(daylight)[1];
  const double luminance = integrate([this](int nm) { return double{at(nm)}; }).y;
  for (int nm = kFirstNm; nm <= kLastNm; ++nm) {
    float& value = values_[static_cast<std::size_t>(nm - kFirstNm)];
    value = !(luminance > 0) ? 0
                             : static_cast<float>(double{value} / luminance * daylight_luminance /
                                                  double{daylight.at(static_cast<float>(nm))});
  }
}

Colour Colour::of(const Rgb& c, ColourSpace space, SpectrumRole role) {
  const Rgb beyond = beyond_rec709(c, space, role), clamped = to_rec709(c, space, role);
  constexpr float kOutside = -1e-4f, kDark = 0.25f;  // of a light's colour: dark spectra reach further
  const float largest = max_component(clamped), least = std::min({beyond.r, beyond.g, beyond.b});
  if (!(least < kOutside * largest) || !std::isfinite(largest) || role == SpectrumRole::unbounded) return {clamped};
  const float strength = role == SpectrumRole::albedo ? 1 : largest / kDark;
  // Whoever carries light multiplies by the luminance of its colour, which clamping has raised.
  const float scale = role == SpectrumRole::albedo ? 1 : strength / luminance(clamped);
  const SmoothSpectrum smooth(beyond / strength, {});
  return {clamped, std::make_shared<const SpectrumByNm>([&](int nm) { return scale * smooth.at(nm); })};
}

}  // namespace dspm
