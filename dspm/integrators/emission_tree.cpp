#include "dspm/integrators/emission_tree.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "dspm/system/parallel.h"

namespace dspm {
namespace {

constexpr std::size_t kLeastRecords = 24;  // of a box that is halved
constexpr std::size_t kMany = 1 << 12;     // records that are worth several threads
constexpr std::size_t kAtOnce = 64;        // boxes that are halved, by as many threads
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
  double gain = 0;
  int box = 0, side = 0;
  friend bool operator<(const Split& a, const Split& b) { return a.gain != b.gain ? a.gain < b.gain : a.box > b.box; }
};

/// Looks two levels ahead: a box whose halves are alike may hold all it has along their border.
double gain(const Box& box, int side) {
  const float low = box.box.low[EmissionBox::slot(side)], size = box.box.size[EmissionBox::slot(side)];
  if (size <= kSmallestSide) return 0;
  std::array<double, 4> quarters{};
  for (const EmissionRecord& record : box.records) {
    const float place = 4 * (record.numbers[EmissionBox::slot(side)] - low) / size;
    quarters[static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, 3))] += record.value;
  }
  double divided = 0;
  for (const double quarter : quarters) divided += deviation(quarter, box.box.volume() / 4);
  return box.deviation() - divided;
}

/// No gain: it stays whole.
Split best_split(const Box& box, int number) {
  Split best{0, number, 0};
  if (box.records.size() < kLeastRecords) return best;
  std::array<double, 4> gains{};
  parallel_for(4, box.records.size() < kMany ? 4 : 1,
               [&](std::int64_t side) { gains[static_cast<std::size_t>(side)] = gain(box, static_cast<int>(side)); });
  for (int side = 0; side < 4; ++side)
    if (const double gain = gains[static_cast<std::size_t>(side)]; gain > best.gain) best = {gain, number, side};
  return best;
}

class Trees {
 public:
  Trees(std::span<EmissionRecord> records, std::span<const float> usual) : usual_(usual) {
    const auto by_light = [](const EmissionRecord& a, const EmissionRecord& b) { return a.light < b.light; };
    if (!std::is_sorted(records.begin(), records.end(), by_light))
      std::stable_sort(records.begin(), records.end(), by_light);
    boxes_.resize(usual.size());
    for (std::size_t light = 0, begin = 0; light < usual.size(); ++light) {
      std::size_t end = begin;
      while (end < records.size() && records[end].light == static_cast<int>(light)) ++end;
      boxes_[light].records = records.subspan(begin, end - begin);
      begin = end;
    }
    splits_of_new_.resize(usual.size());
    parallel_for(static_cast<std::int64_t>(usual.size()), 1, [&](std::int64_t light) { weigh(0, light); });
    queue_splits();
  }

  /// First where the variance falls most. That also puts the nodes that are visited most next to one another.
  void divide() {
    for (std::size_t cells = boxes_.size(); !splits_.empty() && cells < EmissionGuide::kMostCells;) {
      const std::size_t most = std::min(kAtOnce, EmissionGuide::kMostCells - cells);
      std::vector<Split> wave;
      for (; !splits_.empty() && wave.size() < most; splits_.pop()) wave.push_back(splits_.top());
      const std::size_t first = boxes_.size();
      boxes_.resize(first + 2 * wave.size()), splits_of_new_.resize(2 * wave.size());
      parallel_for(static_cast<std::int64_t>(wave.size()), 1, [&](std::int64_t i) {
        halve(wave[static_cast<std::size_t>(i)], first + 2 * static_cast<std::size_t>(i));
        weigh(first, 2 * i), weigh(first, 2 * i + 1);
      });
      queue_splits();
      cells += wave.size();
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
  /// A new box, of those from `first` on.
  void weigh(std::size_t first, std::int64_t number) {
    const std::size_t at = first + static_cast<std::size_t>(number);
    for (const EmissionRecord& record : boxes_[at].records) boxes_[at].value += record.value;
    splits_of_new_[static_cast<std::size_t>(number)] = best_split(boxes_[at], static_cast<int>(at));
  }

  void queue_splits() {
    for (const Split& split : splits_of_new_)
      if (split.gain > 0) splits_.push(split);
  }

  void halve(const Split& split, std::size_t child) {
    Box& box = boxes_[static_cast<std::size_t>(split.box)];
    box.first_child = static_cast<int>(child), box.side = split.side;
    const auto middle = std::partition(box.records.begin(), box.records.end(), [&](const EmissionRecord& record) {
      return record.numbers[EmissionBox::slot(split.side)] < box.box.middle(split.side);
    });
    boxes_[child].box = box.box.half(split.side, false), boxes_[child].records = {box.records.begin(), middle};
    boxes_[child + 1].box = box.box.half(split.side, true), boxes_[child + 1].records = {middle, box.records.end()};
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
  std::vector<Split> splits_of_new_;
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
