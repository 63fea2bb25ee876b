// The waves of a range of paths, one bounce after the other.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace dspm {

/// Calls step(const State&) for each path in `next`, then for those that the steps have left there, until they leave none.
/// With a `shuffle`, the paths of each wave are taken in a random order of that seed.
template <class State, class Step>
void follow_waves(std::vector<State>& next, std::uint64_t shuffle, Step&& step) {
  std::mt19937_64 random(shuffle);
  for (std::vector<State> wave; !next.empty();) {
    std::swap(wave, next);
    next.clear();
    if (shuffle != 0) std::ranges::shuffle(wave, random);
    for (const State& path : wave) step(path);
  }
}

}  // namespace dspm
