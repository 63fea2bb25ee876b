// Sorting by all threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dspm/base/system/parallel.h"
#include "dspm/base/system/untouched.h"

namespace dspm {

/// Sorts. Elements must differ, so that there is only one order.
template <class T>
void parallel_sort(UntouchedVector<T>& values) {
  constexpr std::size_t kChunk = 1 << 16;
  const std::size_t count = values.size();
  const auto at = [count](UntouchedVector<T>& v, std::size_t place) {
    return v.begin() + static_cast<std::ptrdiff_t>(std::min(place, count));
  };
  parallel_chunks(static_cast<std::int64_t>(count), kChunk, [&](std::int64_t begin, std::int64_t end) {
    std::sort(values.begin() + begin, values.begin() + end);
  });
  UntouchedVector<T> merged(count > kChunk ? count : 0);
  for (std::size_t width = kChunk; width < count; width *= 2, values.swap(merged))
    parallel_for(chunk_count(static_cast<std::int64_t>(count), static_cast<std::int64_t>(2 * width)), 1,
                 [&](std::int64_t pair) {
                   const std::size_t begin = static_cast<std::size_t>(pair) * 2 * width;
                   std::merge(at(values, begin), at(values, begin + width), at(values, begin + width),
                              at(values, begin + 2 * width), at(merged, begin));
                 });
}

}  // namespace dspm
