// The median of many values, in linear time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dspm {

/// Returns the larger of the two in the middle if their number is even, and 0 if there are none. Reorders the values.
template <class T>
T median(std::vector<T>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace dspm
