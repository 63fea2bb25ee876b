// The colours of many spectra that are sampled at the same wavelengths: sums over the samples, not over all
// wavelengths.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "dspm/base/colour/rgb.h"

namespace dspm {

class SampledColours {
 public:
  /// Takes the wavelengths of the samples, ascending.
  explicit SampledColours(const std::vector<float>& nm);
  /// Returns to_rgb() of these samples with SpectrumRole::unbounded, up to rounding.
  Rgb of(std::span<const float> values) const;

 private:
  std::vector<std::array<double, 3>> weights_;
};

}  // namespace dspm
