// How samples of direct light are shared out among the lights, for frames that choose lights alike.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "dspm/lights/light_tree.h"

namespace dspm {

/// A few lights that shine are all sampled. If there are more, those infinitely far away, of which a few are all sampled, too, have
/// samples to themselves, and a tree shares out those of the others by what each may send to the point.
class LightSamples {
 public:
  static constexpr std::size_t kFewLights = 8;
  static constexpr std::size_t kFewInfinite = 4;
  static constexpr int kSamplesOfTree = 4;

  struct OfLight {
    double power;
    std::optional<LightBounds> bounds;  // nullopt: it lights everything
  };
  explicit LightSamples(std::span<const OfLight> lights);

  /// Returns the mean number of samples of the light.
  float mean(const LightReceiver& at, std::size_t light) const {
    return !is_in_tree_[light] ? shares_[light]
                               : static_cast<float>(of_tree_) * tree_.probability(at, static_cast<int>(light));
  }
  /// Calls fn(light, mean number of samples, number of samples here) for each light that has some. One number in [0, 1)
  /// spaces them all. Returns how many nodes of the tree were visited.
  template <class Fn>
  int for_each(const LightReceiver& at, double u, Fn&& fn) const;

 private:
  std::vector<float> shares_;  // of lights outside of the tree
  std::vector<bool> is_in_tree_;
  std::vector<std::size_t> outside_;
  LightTree tree_;
  int of_tree_ = 0;
};

template <class Fn>
int LightSamples::for_each(const LightReceiver& at, double u, Fn&& fn) const {
  double sum = -u;
  for (const std::size_t light : outside_) {
    int count = 0;
    for (sum += static_cast<double>(shares_[light]); sum > 0; sum -= 1) ++count;
    if (count > 0) fn(light, shares_[light], count);
  }
  return tree_.choose(at, of_tree_, u, [&](int lamp, float probability, int count, float) {
    fn(static_cast<std::size_t>(lamp), static_cast<float>(of_tree_) * probability, count);
  });
}

}  // namespace dspm
