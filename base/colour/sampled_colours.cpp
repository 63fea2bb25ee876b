#include "dspm/base/colour/sampled_colours.h"

#include <algorithm>
#include <limits>

#include "dspm/base/colour/observer.h"
#include "dspm/base/colour/spectral_curve.h"

namespace dspm {

// The conversion is linear, so a sample's weight is the colour of a spectrum that is 1 there and 0 at all others.
SampledColours::SampledColours(const std::vector<float>& nm) {
  for (std::size_t i = 0; i < nm.size(); ++i) {
    SpectralCurve one{nm, std::vector<float>(nm.size())};
    one.values[i] = 1;
    weights_.push_back(
        under_daylight([&](int at) { return one.at(std::clamp(static_cast<float>(at), nm.front(), nm.back())); }));
  }
}

Rgb SampledColours::of(std::span<const float> values) const {
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < weights_.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weights_[i][c] * static_cast<double>(values[i]);
  return clamped(sum, std::numeric_limits<float>::max());
}

}  // namespace dspm
