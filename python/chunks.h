// Loops over rows whose results differ in number: in parallel, and in the order of the rows.
#pragma once

#include <vector>

#include "dspm/base/system/parallel.h"

namespace dspm::python {

inline constexpr std::int64_t kRowsOfAChunk = 4096;

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// fn(i, Result&) for each row i; what the chunks hold is joined by +=.
template <class Result, class Fn>
Result in_chunks(std::size_t rows, Fn&& fn) {
  const auto count = static_cast<std::int64_t>(rows);
  std::vector<Result> chunks(static_cast<std::size_t>(chunk_count(count, kRowsOfAChunk)));
  parallel_chunks(count, kRowsOfAChunk, [&](std::int64_t begin, std::int64_t end) {
    Result& chunk = chunks[static_cast<std::size_t>(begin / kRowsOfAChunk)];
    for (std::int64_t i = begin; i < end; ++i) fn(static_cast<std::size_t>(i), chunk);
  });
  Result all;
  for (const Result& chunk : chunks) all += chunk;
  return all;
}

}  // namespace dspm::python
