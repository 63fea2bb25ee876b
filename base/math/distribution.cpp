#include "dspm/base/math/distribution.h"

#include <algorithm>

namespace dspm {

Distribution1D::Distribution1D(std::span<const float> weights) {
  double total = 0;
  for (const float weight : weights) total += static_cast<double>(weight);
  total_ = static_cast<float>(total);
  const double n = static_cast<double>(weights.size());
  double sum = 0;
  bins_.resize(weights.size() + 1);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += total > 0 ? static_cast<double>(weights[i]) / total : 1 / n;
    bins_[i + 1].begin = static_cast<float>(std::min(sum, 1.));
  }
  // Rounding may leave the last steps short of 1; bins of zero weight at the end must stay empty.
  const float end = bins_.back().begin;
  for (std::size_t i = weights.size(); i > 0 && bins_[i].begin == end; --i) bins_[i].begin = 1;
  add_cutpoints(bins(), cutpoints_);
}

}  // namespace dspm
