// Bins that cover [0, 1), of any widths, which are their probabilities: which one holds a number? A table of
// "cutpoints" leads to within a few steps of it [Chen and Asau 1974, On Generating Random Variates from an Empirical
// Distribution]. There is one cutpoint for several bins, so that the table stays in the cache even if the bins do not.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace dspm {

/// Bins are stored in ascending order from 0, followed by one more that begins at 1. T below is a Bin or derives from
/// it.
struct Bin {
  float begin = 0;
};

constexpr std::size_t cutpoint_count(std::size_t bins) {
  constexpr std::size_t kBinsOfOne = 4;
  return (bins + kBinsOfOne - 1) / kBinsOfOne;
}

/// Returns the cutpoint to look up for u, of `count`.
constexpr std::size_t cutpoint_of(float u, std::size_t count) {
  return std::min(static_cast<std::size_t>(u * static_cast<float>(count)), count - 1);
}

/// Adds the cutpoints. Cutpoint i of n is where to begin the search for numbers near i / n: the last bin that begins
/// before all of them, or an earlier one if Index counts no further.
template <class Index, class T>
void add_cutpoints(std::span<const T> bins, std::vector<Index>& cutpoints) {
  const std::size_t last = bins.size() - 2, count = cutpoint_count(bins.size() - 1);
  std::size_t bin = 0;
  for (std::size_t i = 0; i < count; ++i) {
    while (bin < last && cutpoint_of(bins[bin + 1].begin, count) < i) ++bin;
    cutpoints.push_back(static_cast<Index>(std::min<std::size_t>(bin, std::numeric_limits<Index>::max())));
  }
}

struct BinChoice {
  int index;
  float probability;  // of this index
  float rest;         // in [0, 1): uniform again, for further use
};

/// Returns the last bin that begins at or below u. An empty bin begins where the next one does, so it is never the
/// last.
template <class T, class Index>
constexpr BinChoice choose_bin(std::span<const T> bins, std::span<const Index> cutpoints, float u) {
  constexpr float kBelowOne = 0x1.fffffep-1f;  // the largest float below 1
  u = std::min(u, kBelowOne);
  std::size_t i = cutpoints[cutpoint_of(u, cutpoints.size())];
  while (bins[i + 1].begin <= u) ++i;
  const float begin = bins[i].begin, width = bins[i + 1].begin - begin;
  return {static_cast<int>(i), width, std::min((u - begin) / width, kBelowOne)};
}

template <class T>
constexpr float probability_of(std::span<const T> bins, int index) {
  const auto i = static_cast<std::size_t>(index);
  return bins[i + 1].begin - bins[i].begin;
}

/// The u for which choose_bin() returns that index and rest.
template <class T>
constexpr float bin_number(std::span<const T> bins, int index, float rest) {
  return bins[static_cast<std::size_t>(index)].begin + rest * probability_of(bins, index);
}

}  // namespace dspm
