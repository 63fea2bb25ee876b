#include "dspm/base/colour/sampled_spectra.h"

#include <algorithm>
#include <cmath>

namespace dspm {

// A node is the mean over a triangle around it, so that no sample is left out. The samples' curve is linear in them, so its
// weights are those of curves that are 1 at one sample and 0 at all others.
SampledSpectra::SampledSpectra(const std::vector<float>& nm, std::size_t count) : shares_(nm.size()) {
  for (std::size_t s = 0; s < nm.size(); ++s) {
    SpectralCurve one{nm, std::vector<float>(nm.size())};
    one.values[s] = 1;
    for (int node = 0; node < kNodes; ++node) {
      float sum = 0;
      for (int away = 1 - kStepNm; away < kStepNm; ++away) {
        const auto at = static_cast<float>(kFirstNm + node * kStepNm + away);
        const float share = static_cast<float>(kStepNm - std::abs(away)) / (kStepNm * kStepNm);
        sum += share * one.at(std::clamp(at, nm.front(), nm.back()));
      }
      if (sum > 0) shares_[s].push_back({node, sum});
    }
  }
  nodes_.resize(count * kNodes);
}

void SampledSpectra::set(std::size_t i, std::span<const float> values) {
  float* const of = &nodes_[i * kNodes];
  std::fill_n(of, kNodes, 0.f);
  for (std::size_t s = 0; s < values.size(); ++s)
    for (const Share& share : shares_[s]) of[share.node] += share.weight * values[s];
}

}  // namespace dspm
