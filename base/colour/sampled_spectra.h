// Many spectra that are sampled at the same wavelengths, for spectral renders: kept in steps of 15 nm, linear in between.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/spectral_curve.h"
#include "dspm/base/colour/spectrum.h"

namespace dspm {

class SampledSpectra {
 public:
  static constexpr int kStepNm = 15, kNodes = (kLastNm - kFirstNm) / kStepNm + 2;

  SampledSpectra() = default;
  /// Takes the wavelengths of the samples, ascending, and the number of spectra.
  SampledSpectra(const std::vector<float>& nm, std::size_t count);
  /// Sets the i-th, which is constant beyond its samples.
  void set(std::size_t i, std::span<const float> values);
  bool empty() const { return nodes_.empty(); }
  /// Returns the i-th at the palette's wavelengths; not for RGB.
  Spectrum at(std::size_t i, const Palette& palette) const {
    const float* const of = &nodes_[i * kNodes];
    Spectrum spectrum;
    for (int k = 0; k < 3; ++k) {
      const int beyond = palette.nm(k) - kFirstNm, node = beyond / kStepNm;
      const float t = static_cast<float>(beyond - node * kStepNm) / kStepNm;
      spectrum[k] = of[node] * (1 - t) + of[node + 1] * t;
    }
    return spectrum;
  }

 private:
  struct Share {
    int node;
    float weight;
  };
  std::vector<std::vector<Share>> shares_;  // that nodes have of each sample
  std::vector<float> nodes_;
};

}  // namespace dspm
