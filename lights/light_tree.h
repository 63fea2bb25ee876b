// Chooses among many lamps for a point that they may light: a tree over their places, whose branches are followed in
// proportion to what they may send there. [Conty Estevez and Kulla 2018; Pharr, Jakob, Humphreys, Physically Based
// Rendering, 4th ed., 12.6.3]
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dspm/lights/four_lamps.h"
#include "dspm/lights/light_bounds.h"

namespace dspm {

class LightTree {
 public:
  struct Lamp {
    LightBounds bounds;
    double power;  // a lamp without any is never chosen
  };
  LightTree() = default;
  explicit LightTree(std::span<const Lamp> lamps);

  bool empty() const { return nodes_.empty(); }
  /// Returns the probability with which a sample at the receiver is one of the lamp: that which choose() tells, to the
  /// bit.
  float probability(const LightReceiver& at, int lamp) const;
  /// Takes the samples that lie at (i + u) / count, i = 0 .. count - 1, in the probabilities of all lamps, one after the
  /// other: systematic sampling. Calls fn(lamp, its probability, how many samples, where the first of them lies within
  /// the lamp, in [0, 1)) for each lamp that has some. Returns how many nodes were visited.
  template <class Fn>
  int choose(const LightReceiver& at, int count, double u, Fn&& fn) const;

 private:
  static constexpr int kChildren = 4;
  static constexpr int kMostLevels = 32;

  struct Node {
    FourLamps lamps;
    std::int32_t children[kChildren] = {};  // a node, or ~lamp; lanes without one come first
  };
  /// Where a lamp is: the child to take at each level from the root, two bits each, the root's lowest.
  struct Way {
    std::uint64_t children = 0;
    bool exists = false;
  };

  /// The probabilities of a node's children.
  class Shares {
   public:
    Shares(const Node& node, const FourReceivers& at) {
      alignas(16) float sent[kChildren];
      _mm_store_ps(sent, node.lamps.importance(at));
      for (std::size_t i = 0; i < kChildren; ++i) below_[i + 1] = below_[i] + double{sent[i]};
      const double per_sum = 1 / below_[kChildren];
      for (std::size_t i = 0; i < kChildren; ++i) of_[i] = double{sent[i]} * per_sum, below_[i] *= per_sum;
    }
    double of(std::size_t child) const { return of_[child]; }
    /// Returns the sum of those of the children before it.
    double below(std::size_t child) const { return below_[child]; }

   private:
    double of_[kChildren], below_[kChildren + 1] = {};
  };

  struct Entry;
  struct Group;
  std::int32_t build(std::span<Entry> entries, std::uint64_t way, int level);

  std::vector<Node> nodes_;
  std::vector<Way> ways_;  // by lamp
};

template <class Fn>
int LightTree::choose(const LightReceiver& at, int count, double u, Fn&& fn) const {
  if (empty()) return 0;
  const FourReceivers receiver(at);
  struct Part {
    std::int32_t child;
    int first, last;    // of its samples; the last is not its own
    double begin, end;  // in samples
    double probability;
  };
  std::array<Part, (kChildren - 1) * kMostLevels + 1> stack;
  stack[0] = {0, 0, count, 0, static_cast<double>(count), 1};
  std::size_t size = count > 0 ? 1 : 0;
  int visited = 0;
  while (size > 0) {
    const Part part = stack[--size];
    ++visited;
    const double width = part.end - part.begin;
    if (part.child < 0) {
      const double within = std::clamp((part.first + u - part.begin) / width, 0., 1 - 0x1p-24);
      fn(static_cast<int>(~part.child), static_cast<float>(part.probability), part.last - part.first,
         static_cast<float>(within));
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(part.child)];
    const Shares shares(node, receiver);
    double end = part.end;
    int last = part.last;
    for (std::size_t i = kChildren; i-- > 0 && last > part.first;) {
      const double begin = part.begin + width * shares.below(i);
      const int first = std::max(part.first, static_cast<int>(std::ceil(begin - u)));
      if (first < last) stack[size++] = {node.children[i], first, last, begin, end, part.probability * shares.of(i)};
      end = begin, last = std::min(first, last);
    }
  }
  return visited;
}

}  // namespace dspm
