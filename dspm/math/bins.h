// Bins that cover [0, 1), of any widths: which one holds a number? Found in about one step from a place that is looked
// up, the bin that begins where that of a slightly smaller number may be: "cutpoints" [Chen and Asau 1974, On Generating
// Random Variates from an Empirical Distribution]. A bin's width is its probability.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dspm {

struct Bin {
  float begin = 0;
  /// Of bin i of n: where to begin the search for numbers near i / n. As weights mostly vary slowly, that is close by.
  std::uint32_t first = 0;
};

inline std::size_t cutpoint_of(float u, std::size_t count) {
  return std::min(static_cast<std::size_t>(u * static_cast<float>(count)), count - 1);
}

/// Sets Bin::first. The bins are given by where they begin, in ascending order from 0; then comes one more, at 1.
/// T: a Bin, perhaps with more in it.
template <class T>
void set_cutpoints(std::span<T> bins) {
  const std::size_t count = bins.size() - 1;
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < count; ++i) {
    while (first + 1 < count && cutpoint_of(bins[first + 1].begin, count) < i) ++first;
    bins[i].first = first;
  }
}

struct BinChoice {
  int index;
  float probability;  // of this index
  float rest;         // in [0, 1): uniform again, for further use
};

/// The last bin that begins at or below u. An empty bin begins where the next one does, so it is never the last.
template <class T>
BinChoice choose_bin(std::span<const T> bins, float u) {
  constexpr float kBelowOne = 0x1.fffffep-1f;  // the largest float below 1
  u = std::min(u, kBelowOne);
  std::size_t i = bins[cutpoint_of(u, bins.size() - 1)].first;
  while (bins[i + 1].begin <= u) ++i;
  const float begin = bins[i].begin, width = bins[i + 1].begin - begin;
  return {static_cast<int>(i), width, std::min((u - begin) / width, kBelowOne)};
}

template <class T>
float probability_of(std::span<const T> bins, int index) {
  const auto i = static_cast<std::size_t>(index);
  return bins[i + 1].begin - bins[i].begin;
}

/// The u for which choose_bin() returns that index and rest.
template <class T>
float bin_number(std::span<const T> bins, int index, float rest) {
  return bins[static_cast<std::size_t>(index)].begin + rest * probability_of(bins, index);
}

}  // namespace dspm
