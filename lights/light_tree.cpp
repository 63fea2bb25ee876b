#include "dspm/lights/light_tree.h"

#include <algorithm>
#include <limits>

namespace dspm {

struct LightTree::Entry {
  const Lamp* lamp;
  int index;
  Vec3 center;
};

namespace {

constexpr int kBins = 12;
constexpr int kHalvesFrom = 32;  // levels: a tree that is so deep halves its lamps from there on

/// What it costs if the lamps are one node: light in doubt. Lamps on a line or in one place count as well.
/// [Conty Estevez and Kulla 2018, 4.4]
double cost_of(const LightBounds& bounds, double power) {
  if (bounds.box.empty()) return 0;
  const Vec3 e = bounds.box.extent();
  return power * bounds.solid_angle() * static_cast<double>(bounds.box.half_area() + 0.01f * length2(e));
}

struct Group {
  LightBounds bounds{{}, {0, 0, 1}, 0, 0, false};
  double power = 0;

  void add(const LightBounds& other, double of_power) { bounds.add(other), power += of_power; }
  void add(const Group& other) { add(other.bounds, other.power); }
  double cost() const { return cost_of(bounds, power); }
};

}  // namespace

LightTree::LightTree(std::span<const Lamp> lamps) : leaf_of_(lamps.size(), -1) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < lamps.size(); ++i)
    if (lamps[i].power > 0 && !lamps[i].bounds.box.empty())
      entries.push_back({&lamps[i], static_cast<int>(i), lamps[i].bounds.box.center()});
  if (entries.empty()) return;
  nodes_.reserve(2 * entries.size());
  build(entries, -1, 0);
}

int LightTree::build(std::span<Entry> entries, int parent, int depth) {
  const auto at = nodes_.size();
  LightBounds bounds = entries.front().lamp->bounds;
  Bounds3 centers;
  double intensity = 0;
  for (const Entry& entry : entries) {
    bounds.add(entry.lamp->bounds), centers.add(entry.center);
    intensity += entry.lamp->power / entry.lamp->bounds.solid_angle();
  }
  Node& node = nodes_.emplace_back();
  node.center = bounds.box.center(), node.radius2 = 0.25f * length2(bounds.box.extent());
  node.axis = bounds.axis, node.two_sided = bounds.two_sided;
  node.cos_spread = std::cos(bounds.spread), node.sin_spread = std::max(0.f, std::sin(bounds.spread));
  node.cos_reach = std::cos(bounds.reach);
  node.intensity = static_cast<float>(intensity);
  node.parent = parent, node.is_lamp = entries.size() == 1;
  if (node.is_lamp) {
    node.other = entries.front().index;
    leaf_of_[static_cast<std::size_t>(entries.front().index)] = static_cast<std::int32_t>(at);
    return static_cast<int>(at);
  }
  const std::size_t middle = depth < kHalvesFrom ? split(entries, centers) : entries.size() / 2;
  build(entries.first(middle), static_cast<int>(at), depth + 1);
  const int second = build(entries.subspan(middle), static_cast<int>(at), depth + 1);
  nodes_[at].other = second;
  return static_cast<int>(at);
}

std::size_t LightTree::split(std::span<Entry> entries, const Bounds3& centers) const {
  const Vec3 extent = centers.extent();
  const auto bin_of = [&](const Entry& entry, int axis) {
    const float place = (entry.center[axis] - centers.low[axis]) / extent[axis];
    return std::min(static_cast<int>(place * kBins), kBins - 1);
  };
  double best = std::numeric_limits<double>::infinity();
  int best_axis = -1, best_bin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(extent[axis] > 0)) continue;
    std::array<Group, kBins> bins;
    for (const Entry& entry : entries)
      bins[static_cast<std::size_t>(bin_of(entry, axis))].add(entry.lamp->bounds, entry.lamp->power);
    std::array<double, kBins> above{};
    Group from_end;
    for (std::size_t i = kBins - 1; i > 0; --i) from_end.add(bins[i]), above[i] = from_end.cost();
    Group from_begin;
    // Thin boxes are split across first.
    const double thinness = static_cast<double>(max_component(extent) / extent[axis]);
    for (std::size_t i = 1; i < kBins; ++i) {
      from_begin.add(bins[i - 1]);
      const double cost = thinness * (from_begin.cost() + above[i]);
      if (from_begin.power > 0 && cost < best) best = cost, best_axis = axis, best_bin = static_cast<int>(i);
    }
  }
  if (best_axis < 0) return entries.size() / 2;
  const auto middle = std::stable_partition(entries.begin(), entries.end(),
                                            [&](const Entry& entry) { return bin_of(entry, best_axis) < best_bin; });
  const auto first = static_cast<std::size_t>(middle - entries.begin());
  return first == 0 || first == entries.size() ? entries.size() / 2 : first;
}

float LightTree::probability(const LightReceiver& at, int lamp) const {
  auto node = leaf_of_.empty() ? -1 : leaf_of_[static_cast<std::size_t>(lamp)];
  if (node < 0) return 0;
  double probability = 1;
  for (std::int32_t parent = nodes_[static_cast<std::size_t>(node)].parent; parent >= 0;
       node = parent, parent = nodes_[static_cast<std::size_t>(node)].parent) {
    const double first = share_of_first(static_cast<std::size_t>(parent), at);
    probability *= node == parent + 1 ? first : 1 - first;
  }
  return static_cast<float>(probability);
}

}  // namespace dspm
