#include "dspm/lights/light_tree.h"

#include <algorithm>
#include <limits>

#include "dspm/base/math/vec.h"

namespace dspm {

struct LightTree::Entry {
  const Lamp* lamp;
  int index;
  Vec3 center;
};

/// Lamps that are next to one another among the entries.
struct LightTree::Group {
  std::span<Entry> entries;
  LightBounds bounds;
  Bounds3 centers;
  double intensity = 0, cost = 0;

  explicit Group(std::span<Entry> lamps);
  /// Returns how many of the lamps, which it sorts, are the first of two groups.
  std::size_t split() const;
};

namespace {

constexpr int kBins = 12;
constexpr int kHalvesFrom = 16;  // levels: a tree that is so deep halves its lamps from there on

/// What it costs if the lamps are one node: light in doubt. Lamps on a line or in one place count as well.
/// [Conty Estevez and Kulla 2018, 4.4]
double cost_of(const LightBounds& bounds, double power) {
  if (bounds.box.empty()) return 0;
  const Vec3 e = bounds.box.extent();
  return power * bounds.solid_angle() * static_cast<double>(bounds.box.half_area() + 0.01f * length2(e));
}

struct LampBin {
  LightBounds bounds{{}, {0, 0, 1}, 0, 0, false};
  double power = 0;

  void add(const LightBounds& other, double of_power) { bounds.add(other), power += of_power; }
  void add(const LampBin& other) { add(other.bounds, other.power); }
  double cost() const { return cost_of(bounds, power); }
};

}  // namespace

LightTree::Group::Group(std::span<Entry> lamps) : entries(lamps), bounds(lamps.front().lamp->bounds) {
  double power = 0;
  for (const Entry& entry : entries) {
    bounds.add(entry.lamp->bounds), centers.add(entry.center);
    intensity += entry.lamp->power / entry.lamp->bounds.solid_angle();
    power += entry.lamp->power;
  }
  cost = cost_of(bounds, power);
}

std::size_t LightTree::Group::split() const {
  const Vec3 extent = centers.extent();
  const auto bin_of = [&](const Entry& entry, int axis) {
    const float place = (entry.center[axis] - centers.low[axis]) / extent[axis];
    return std::min(static_cast<int>(place * kBins), kBins - 1);
  };
  double best = std::numeric_limits<double>::infinity();
  int best_axis = -1, best_bin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(extent[axis] > 0)) continue;
    std::array<LampBin, kBins> bins;
    for (const Entry& entry : entries)
      bins[static_cast<std::size_t>(bin_of(entry, axis))].add(entry.lamp->bounds, entry.lamp->power);
    std::array<double, kBins> above{};
    LampBin from_end;
    for (std::size_t i = kBins - 1; i > 0; --i) from_end.add(bins[i]), above[i] = from_end.cost();
    LampBin from_begin;
    // Thin boxes are split across first.
    const double thinness = static_cast<double>(max_component(extent) / extent[axis]);
    for (std::size_t i = 1; i < kBins; ++i) {
      from_begin.add(bins[i - 1]);
      const double split_cost = thinness * (from_begin.cost() + above[i]);
      if (from_begin.power > 0 && split_cost < best)
        best = split_cost, best_axis = axis, best_bin = static_cast<int>(i);
    }
  }
  if (best_axis < 0) return entries.size() / 2;
  const auto middle = std::stable_partition(entries.begin(), entries.end(),
                                            [&](const Entry& entry) { return bin_of(entry, best_axis) < best_bin; });
  const auto first = static_cast<std::size_t>(middle - entries.begin());
  return first == 0 || first == entries.size() ? entries.size() / 2 : first;
}

LightTree::LightTree(std::span<const Lamp> lamps) : ways_(lamps.size()) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < lamps.size(); ++i)
    if (lamps[i].power > 0 && !lamps[i].bounds.box.empty())
      entries.push_back({&lamps[i], static_cast<int>(i), lamps[i].bounds.box.center()});
  if (!entries.empty()) build(entries, 0, 0);
}

// The group with most light in doubt is split first; deep down, that with most lamps.
std::int32_t LightTree::build(std::span<Entry> entries, std::uint64_t way, int level) {
  std::vector<Group> groups{Group(entries)};
  const bool halves = level >= kHalvesFrom;
  const auto urgency = [&](const Group& group) {
    const auto size = static_cast<double>(group.entries.size());
    return size == 1 ? -1 : halves ? size : group.cost;
  };
  while (groups.size() < kChildren) {
    const auto most = std::max_element(groups.begin(), groups.end(),
                                       [&](const Group& a, const Group& b) { return urgency(a) < urgency(b); });
    const std::span<Entry> all = most->entries;
    if (all.size() == 1) break;
    const std::size_t middle = halves ? all.size() / 2 : most->split();
    *most = Group(all.first(middle));
    groups.insert(most + 1, Group(all.subspan(middle)));
  }
  const std::size_t at = nodes_.size(), unused = kChildren - groups.size();
  nodes_.emplace_back();
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Group& group = groups[i];
    const std::size_t lane = unused + i;
    const std::uint64_t there = way | std::uint64_t{lane} << 2 * level;
    nodes_[at].lamps.set(lane, group.bounds, group.intensity);
    const int lamp = group.entries.front().index;
    if (group.entries.size() == 1) ways_[static_cast<std::size_t>(lamp)] = {there, true};
    const std::int32_t child = group.entries.size() == 1 ? ~lamp : build(group.entries, there, level + 1);
    nodes_[at].children[lane] = child;
  }
  return static_cast<std::int32_t>(at);
}

float LightTree::probability(const LightReceiver& at, int lamp) const {
  if (ways_.empty() || !ways_[static_cast<std::size_t>(lamp)].exists) return 0;
  const FourReceivers receiver(at);
  std::uint64_t way = ways_[static_cast<std::size_t>(lamp)].children;
  double probability = 1;
  for (std::int32_t child = 0; child >= 0; way >>= 2) {
    const Node& node = nodes_[static_cast<std::size_t>(child)];
    probability *= Shares(node, receiver).of(way & 3);
    child = node.children[way & 3];
  }
  return static_cast<float>(probability);
}

}  // namespace dspm
