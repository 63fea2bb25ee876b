#include "dspm/base/colour/colour.h"

#include <algorithm>

#include "dspm/base/colour/observer.h"

namespace dspm {

SpectrumByNm::SpectrumByNm(const SpectralCurve& curve, SpectrumRole role) {
  static const SpectralCurve daylight = *named_spectrum("stdillum-D65");
  static const double daylight_luminance = to_xyz(daylight)[1];
  const double luminance = role == SpectrumRole::illuminant ? to_xyz(curve)[1] : 0;
  for (int nm = kFirstNm; nm <= kLastNm; ++nm) {
    const float at = static_cast<float>(nm);
    float& value = values_[static_cast<std::size_t>(nm - kFirstNm)];
    switch (role) {
      case SpectrumRole::albedo: value = std::clamp(curve.at(at), 0.f, 1.f); break;
      case SpectrumRole::unbounded:
        value = curve.nm.empty() ? 0 : std::max(0.f, curve.at(std::clamp(at, curve.nm.front(), curve.nm.back())));
        break;
      case SpectrumRole::illuminant:
        value = !(luminance > 0) ? 0
                                 : static_cast<float>(std::max(0., double{curve.at(at)}) / luminance *
                                                      daylight_luminance / double{daylight.at(at)});
        break;
    }
  }
}

}  // namespace dspm
