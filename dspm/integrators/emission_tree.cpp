#include "dspm/integrators/emission_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

namespace dspm {
namespace {

constexpr std::size_t kLeastRecords = 24;  // of a box that is halved
constexpr float kSmallestSide = 0x1p-16f;  // leaves numbers of 24 bits 8 of them
constexpr double kDefensive = 0.25;        // the share of paths that start as without a guide
constexpr double kClimbs = 0.6;            // the chance that a draw leaves its box for the next larger one

/// Photons drawn from boxes of volume v whose records add up to S have the least variance if each box gets a share of
/// them in proportion to this; the variance is then the square of the sum over the boxes.
double deviation(double value, double volume) { return std::sqrt(value * volume); }

struct Box {
  EmissionBox box;
  std::span<EmissionRecord> records;
  double value = 0;  // of the records
  int first_child = -1, side = 0;
  double drawn = 0;  // how often a draw ends here, not yet normalised

  double deviation() const { return dspm::deviation(value, box.volume()); }
};

struct Split {
  double gain;
  int box, side;
  friend bool operator<(const Split& a, const Split& b) { return a.gain != b.gain ? a.gain < b.gain : a.box > b.box; }
};

/// Looks two levels ahead: a box whose halves are alike may hold all it has along their border.
std::optional<Split> best_split(const Box& box, int number) {
  if (box.records.size() < kLeastRecords) return {};
  Split best{0, number, 0};
  for (int side = 0; side < 4; ++side) {
    const float low = box.box.low[EmissionBox::slot(side)], size = box.box.size[EmissionBox::slot(side)];
    if (size <= kSmallestSide) continue;
    std::array<double, 4> quarters{};
    for (const EmissionRecord& record : box.records) {
      const float place = 4 * (record.numbers[EmissionBox::slot(side)] - low) / size;
      quarters[static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, 3))] += record.value;
    }
    double divided = 0;
    for (const double quarter : quarters) divided += deviation(quarter, box.box.volume() / 4);
    if (const double gain = box.deviation() - divided; gain > best.gain) best = {gain, number, side};
  }
  return best.gain > 0 ? std::optional(best) : std::nullopt;
}

class Trees {
 public:
  Trees(std::span<EmissionRecord> records, std::span<const float> usual) : usual_(usual) {
    std::sort(records.begin(), records.end(), [](const EmissionRecord& a, const EmissionRecord& b) {
      return a.light != b.light ? a.light < b.light : a.numbers < b.numbers;
    });
    for (std::size_t light = 0, begin = 0; light < usual.size(); ++light) {
      std::size_t end = begin;
      while (end < records.size() && records[end].light == static_cast<int>(light)) ++end;
      add({{}, records.subspan(begin, end - begin)});
      begin = end;
    }
  }

  /// First where the variance falls most.
  void divide() {
    for (std::size_t cells = boxes_.size(); !splits_.empty() && cells < EmissionGuide::kMostCells; ++cells) {
      const Split split = splits_.top();
      splits_.pop();
      divide(split);
    }
  }

  EmissionGuide guide() {
    for (std::size_t light = 0; light < usual_.size(); ++light) settle(light, 0);
    std::vector<EmissionGuide::Node> nodes;
    for (const Box& box : boxes_) nodes.push_back({0, box.first_child, box.side});
    const bool any = drawn_ > 0;
    for (std::size_t light = 0; light < usual_.size(); ++light)
      collect(light, static_cast<double>(usual_[light]) * (any ? kDefensive : 1), any ? (1 - kDefensive) / drawn_ : 0,
              nodes);
    return {static_cast<int>(usual_.size()), std::move(nodes)};
  }

 private:
  void add(Box box) {
    for (const EmissionRecord& record : box.records) box.value += record.value;
    if (const auto split = best_split(box, static_cast<int>(boxes_.size()))) splits_.push(*split);
    boxes_.push_back(box);
  }

  void divide(const Split& split) {
    Box& box = boxes_[static_cast<std::size_t>(split.box)];
    box.first_child = static_cast<int>(boxes_.size()), box.side = split.side;
    const EmissionBox whole = box.box;
    const std::span<EmissionRecord> records = box.records;
    const auto middle = std::partition(records.begin(), records.end(), [&](const EmissionRecord& record) {
      return record.numbers[EmissionBox::slot(split.side)] < whole.middle(split.side);
    });
    add({whole.half(split.side, false), {records.begin(), middle}});
    add({whole.half(split.side, true), {middle, records.end()}});
  }

  /// Draws climb from their cells, as paths next to those that were found matter, too. Sets `drawn` of the box and all
  /// within; returns what leaves the box for the next larger one.
  double settle(std::size_t number, double climbs) {
    const int child = boxes_[number].first_child;
    double arriving = boxes_[number].deviation();
    if (child >= 0)
      arriving =
          settle(static_cast<std::size_t>(child), kClimbs) + settle(static_cast<std::size_t>(child) + 1, kClimbs);
    boxes_[number].drawn = arriving * (1 - climbs);
    drawn_ += boxes_[number].drawn;
    return arriving * climbs;
  }

  /// `density`: of what is drawn from the larger boxes.
  void collect(std::size_t number, double density, double guided, std::vector<EmissionGuide::Node>& nodes) const {
    const Box& box = boxes_[number];
    density += guided * box.drawn / box.box.volume();
    nodes[number].probability = density * box.box.volume();
    if (box.first_child < 0) return;
    collect(static_cast<std::size_t>(box.first_child), density, guided, nodes);
    collect(static_cast<std::size_t>(box.first_child) + 1, density, guided, nodes);
  }

  std::span<const float> usual_;
  std::vector<Box> boxes_;  // first those of all numbers, by light
  std::priority_queue<Split> splits_;
  double drawn_ = 0;  // by all boxes
};

}  // namespace

EmissionGuide guide_from(std::span<EmissionRecord> records, std::span<const float> usual) {
  Trees trees(records, usual);
  trees.divide();
  return trees.guide();
}

}  // namespace dspm
