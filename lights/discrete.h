// Choosing one of n items in proportion to their weights.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace dspm {

class DiscreteDistribution {
 public:
  struct Choice {
    int index;
    float probability;  // above 0
    float u;            // what is left of the random number: in [0, 1) again
  };

  /// The weights are finite and not below 0.
  explicit DiscreteDistribution(std::span<const float> weights) : cdf_{0} {
    double sum = 0;
    for (const float w : weights) total_ += static_cast<double>(w);
    cdf_.reserve(weights.size() + 1);
    for (const float w : weights) cdf_.push_back(static_cast<float>((sum += static_cast<double>(w)) / total_));
  }

  /// Only where total() > 0; u in [0, 1).
  Choice sample(float u) const {
    // The first entry above u: never an item of probability 0.
    const auto above = std::upper_bound(cdf_.begin() + 1, cdf_.end() - 1, u);
    const float begin = *(above - 1), width = *above - begin;
    const float rest = std::min((u - begin) / width, 0x1.fffffep-1f);
    return {static_cast<int>(above - cdf_.begin()) - 1, width, rest};
  }
  /// As sample() really chooses, rounding included.
  float probability(int index) const {
    const auto i = static_cast<std::size_t>(index);
    return total_ > 0 ? cdf_[i + 1] - cdf_[i] : 0;
  }
  double total() const { return total_; }

 private:
  std::vector<float> cdf_;
  double total_ = 0;
};

}  // namespace dspm
