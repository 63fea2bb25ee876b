// Chooses among many lamps for a point that they may light: a tree over their places, whose branches are followed in
// proportion to what they may send there. [Conty Estevez and Kulla 2018; Pharr, Jakob, Humphreys, Physically Based
// Rendering, 4th ed., 12.6.3]
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/lights/light_bounds.h"

namespace dspm {

/// A point that gets light. The normal, which may point to either side, is zero if it is not known.
struct LightReceiver {
  Vec3 p, n = {};
};

class LightTree {
 public:
  struct Lamp {
    LightBounds bounds;
    double power;  // a lamp without any is never chosen
  };
  LightTree() = default;
  explicit LightTree(std::span<const Lamp> lamps);

  bool empty() const { return nodes_.empty(); }
  /// Returns the probability with which a sample at the receiver is one of the lamp.
  float probability(const LightReceiver& at, int lamp) const;
  /// Takes the samples that lie at (i + u) / count, i = 0 .. count - 1, in the probabilities of all lamps, one after the
  /// other: systematic sampling. Calls fn(lamp, its probability, how many samples, where the first of them lies within
  /// the lamp, in [0, 1)) for each lamp that has some. Returns how many nodes were visited.
  template <class Fn>
  int choose(const LightReceiver& at, int count, double u, Fn&& fn) const;

 private:
  // Lets rounding, and lamps that are not quite where their bounds say, do no harm.
  static constexpr float kLeastCosine = 1e-4f;
  static constexpr int kDeepest = 64;

  struct Node {
    Vec3 center;
    float radius2;  // of the sphere around the box
    Vec3 axis;
    float cos_spread, sin_spread, cos_reach;
    float intensity;  // sent along its normals, by all lamps together
    bool two_sided;
    bool is_lamp;
    std::int32_t other;  // the second child, as the first follows its parent; or the lamp
    std::int32_t parent;
  };

  struct Entry;
  int build(std::span<Entry> entries, int parent, int depth);
  std::size_t split(std::span<Entry> entries, const Bounds3& centers) const;
  float importance(const Node& node, const LightReceiver& at) const;
  /// Returns the part of a node's samples that its first child gets.
  double share_of_first(std::size_t node, const LightReceiver& at) const;

  std::vector<Node> nodes_;
  std::vector<std::int32_t> leaf_of_;  // by lamp; -1: none
};

// The cosine to the nearest normal of the cone, for the direction of the box's sphere that is best for it, over the
// squared distance. Within the sphere it may be any direction. [Pharr, Jakob, Humphreys, 12.6.3]
inline float LightTree::importance(const Node& node, const LightReceiver& at) const {
  const Vec3 d = at.p - node.center;
  const float d2 = length2(d);
  if (!(d2 > node.radius2)) return node.intensity / std::max(node.radius2, 1e-30f);
  // Differences of angles, which stop at zero, from their sines and cosines.
  struct Angle {
    float sin, cos;
    Angle less(const Angle& by) const {
      return cos > by.cos ? Angle{0, 1} : Angle{sin * by.cos - cos * by.sin, cos * by.cos + sin * by.sin};
    }
  };
  const auto of_cosine = [](float c) { return Angle{std::sqrt(std::max(0.f, 1 - c * c)), c}; };
  const float sin2_box = node.radius2 / d2, per_length = 1 / std::sqrt(d2);
  const Angle box{std::sqrt(sin2_box), std::sqrt(1 - sin2_box)};
  float cosine = dot(node.axis, d) * per_length;
  if (node.two_sided) cosine = std::abs(cosine);
  const Angle left = of_cosine(cosine).less({node.sin_spread, node.cos_spread}).less(box);
  float factor = left.cos > node.cos_reach ? std::max(left.cos, kLeastCosine) : kLeastCosine;
  if (!(at.n == Vec3{})) factor *= std::max(of_cosine(std::abs(dot(at.n, d)) * per_length).less(box).cos, kLeastCosine);
  return node.intensity * factor / d2;
}

inline double LightTree::share_of_first(std::size_t node, const LightReceiver& at) const {
  const auto first = static_cast<double>(importance(nodes_[node + 1], at)),
             second = static_cast<double>(importance(nodes_[static_cast<std::size_t>(nodes_[node].other)], at));
  const double share = first / (first + second);
  return share >= 0 && share <= 1 ? share : 0.5;
}

template <class Fn>
int LightTree::choose(const LightReceiver& at, int count, double u, Fn&& fn) const {
  if (empty()) return 0;
  struct Part {
    std::size_t node;
    double begin, end;  // in samples
  };
  std::array<Part, kDeepest + 1> stack;
  int top = 0, visited = 0;
  stack[0] = {0, 0, static_cast<double>(count)};
  while (top >= 0) {
    const Part part = stack[static_cast<std::size_t>(top--)];
    const double first = std::max(0., std::ceil(part.begin - u));
    const int here = static_cast<int>(std::max(0., std::ceil(part.end - u)) - first);
    if (here <= 0) continue;
    ++visited;
    const Node& node = nodes_[part.node];
    const double width = part.end - part.begin;
    if (node.is_lamp) {
      const double within = std::min((first + u - part.begin) / width, 1 - 0x1p-24);
      fn(static_cast<int>(node.other), static_cast<float>(width / count), here, static_cast<float>(within));
      continue;
    }
    const double middle = part.begin + width * share_of_first(part.node, at);
    stack[static_cast<std::size_t>(++top)] = {static_cast<std::size_t>(node.other), middle, part.end};
    stack[static_cast<std::size_t>(++top)] = {part.node + 1, part.begin, middle};
  }
  return visited;
}

}  // namespace dspm
