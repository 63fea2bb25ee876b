// What an author says of a colour: red, green and blue, or a spectrum, which a spectral render takes as it is.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <memory>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectral_curve.h"

namespace dspm {

/// Values at each nm from 360 to 830 as paths carry them: of light, over those of daylight of the same luminance.
class SpectrumByNm {
 public:
  /// Reflectances are clamped to 0..1. Light has a luminance of 1.
  SpectrumByNm(const SpectralCurve& curve, SpectrumRole role);
  /// Takes at(nm) as it is.
  template <std::invocable<int> At>
  explicit SpectrumByNm(At&& at) {
    for (int nm = kFirstNm; nm <= kLastNm; ++nm) values_[static_cast<std::size_t>(nm - kFirstNm)] = at(nm);
  }
  float at(int nm) const { return values_[static_cast<std::size_t>(nm - kFirstNm)]; }
  friend bool operator==(const SpectrumByNm&, const SpectrumByNm&) = default;

 private:
  std::array<float, kLastNm - kFirstNm + 1> values_;
};

struct Colour {
  Rgb rgb;
  std::shared_ptr<const SpectrumByNm> spectrum = nullptr;  // null: red, green and blue is all that there is

  static Colour of(const SpectralCurve& curve, SpectrumRole role) {
    return {to_rgb(curve, role), std::make_shared<const SpectrumByNm>(curve, role)};
  }
  /// Outside of Rec. 709, the colour has the smooth spectrum that comes closest to it.
  static Colour of(const Rgb& c, ColourSpace space, SpectrumRole role);
};

}  // namespace dspm
