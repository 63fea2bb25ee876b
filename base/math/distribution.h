// Piecewise-constant distributions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/math/bins.h"

namespace dspm {

/// n weights as a density over [0, 1) that is constant on each of n equal bins, and as a choice among n items.
class Distribution1D {
 public:
  using Choice = BinChoice;

  /// Needs at least one weight; all must be finite and non-negative. If all are zero, they count as equal.
  explicit Distribution1D(std::span<const float> weights);

  Choice choose(float u) const { return choose_bin(bins(), std::span<const std::uint32_t>(cutpoints_), u); }
  float probability(int index) const { return probability_of(bins(), index); }
  /// Returns the u for which choose(u) returns that index and rest.
  float number(int index, float rest) const { return bin_number(bins(), index, rest); }
  int size() const { return static_cast<int>(bins_.size()) - 1; }
  float total() const { return total_; }  // the sum of the weights
  /// Returns one bin more than there are weights; the last begins at 1.
  std::span<const Bin> bins() const { return bins_; }

 private:
  std::vector<Bin> bins_;
  std::vector<std::uint32_t> cutpoints_;
  float total_;
};

}  // namespace dspm
