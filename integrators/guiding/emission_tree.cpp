#include "dspm/integrators/guiding/emission_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/guiding/quarter_sums.h"

namespace dspm {
namespace {

constexpr std::size_t kLeastRecords = 24;  // of a box that is halved
constexpr std::size_t kSummed = 256;       // records whose values are summed up before those of others
constexpr std::size_t kAtOnce = 1 << 10;   // records that are worth no second thread
constexpr float kSmallestSide = 0x1p-16f;  // leaves numbers of 24 bits 8 of them
constexpr double kDefensive = 0.25;        // the share of paths that start as without a guide
constexpr double kClimbs = 0.6;            // the chance that a draw leaves its box for the next larger one
// The part of a record's value that is assumed to lie beside it, within so many sides of its box.
constexpr double kBeside = 0.01;
constexpr float kFarthestBeside = 1.5f;

using Records = std::span<EmissionRecord>;

/// Photons drawn from boxes of volume v whose records add up to S have the least variance if each box gets a share of
/// them in proportion to this; the variance is then the square of the sum over the boxes.
double deviation(double value, double volume) { return std::sqrt(value * volume); }

struct Box {
  EmissionBox box;
  Records records, room;  // room: for the halves' records
  std::size_t place = 0;  // of its first record, among all
  double value = 0;       // of the records
  std::unique_ptr<std::array<Box, 2>> halves;
  int side = 0;                    // the side that is halved
  double worth = 0;                // of halving it, at most that of halving the larger box
  double arriving = 0, drawn = 0;  // how often a draw comes here, and ends here, not yet normalised
  double drawn_within = 0;         // and in all boxes within
  std::size_t boxes_within = 0;

  double deviation() const { return dspm::deviation(value, box.volume()); }
};

std::int64_t chunks_of(Records records) { return chunk_count(static_cast<std::int64_t>(records.size()), kSummed); }

/// Calls fn(some of the records, the number of their chunk).
template <class Fn>
void for_each_chunk(Records records, Fn&& fn) {
  parallel_for(chunks_of(records), kAtOnce / kSummed, [&](std::int64_t i) {
    const auto chunk = static_cast<std::size_t>(i);
    fn(records.subspan(chunk * kSummed, std::min(kSummed, records.size() - chunk * kSummed)), chunk);
  });
}

/// Calls fn(a half, whether it is the upper one).
template <class Fn>
void for_each_half(Box& box, Fn&& fn) {
  if (box.records.size() <= kAtOnce) return fn((*box.halves)[0], false), fn((*box.halves)[1], true);
  parallel_for(2, 1, [&](std::int64_t upper) { fn((*box.halves)[static_cast<std::size_t>(upper)], upper == 1); });
}

/// Looks two levels ahead: a box whose halves are alike may hold all it has along their border.
double gain(const Box& box, const QuarterSums& sums, int side) {
  if (box.box.size[EmissionBox::slot(side)] <= kSmallestSide) return 0;
  double divided = 0;
  for (const double quarter : sums.values(EmissionBox::slot(side))) divided += deviation(quarter, box.box.volume() / 4);
  return box.deviation() - divided;
}

/// Halves the box. Records go to the halves in their order. `sums` holds sums by chunk; `low` of the records are in the
/// lower half.
void halve(Box& box, const std::vector<QuarterSums>& sums, std::size_t low) {
  const std::size_t side = EmissionBox::slot(box.side);
  std::vector<std::size_t> low_before(sums.size());
  for (std::size_t chunk = 1; chunk < sums.size(); ++chunk)
    low_before[chunk] = low_before[chunk - 1] + sums[chunk - 1].below(side);
  for_each_chunk(box.records, [&](Records records, std::size_t chunk) {
    std::size_t next[] = {low_before[chunk], low + chunk * kSummed - low_before[chunk]};
    const EmissionBox whole = box.box;              // a copy stays in registers: no write to a record may change it
    for (const EmissionRecord& record : records) {  // no branches: they would be mispredicted
      const bool upper = is_in_upper_half(record, whole, side);
      box.room[next[upper]++] = record;
    }
  });
  box.halves = std::make_unique<std::array<Box, 2>>();
  for (const bool upper : {false, true}) {
    Box& half = (*box.halves)[upper];
    const std::size_t first = upper ? low : 0, count = upper ? box.records.size() - low : low;
    half.box = box.box.half(box.side, upper);
    half.records = box.room.subspan(first, count), half.room = box.records.subspan(first, count);
    half.place = box.place + first;
  }
}

/// Halves boxes as long as that gains anything.
void grow(Box& box, double most_worth) {
  std::vector<QuarterSums> sums(static_cast<std::size_t>(chunks_of(box.records)));
  for_each_chunk(box.records, [&](Records records, std::size_t chunk) { sums[chunk] = {records, box.box}; });
  const QuarterSums all = std::accumulate(sums.begin(), sums.end(), QuarterSums(),
                                          [](QuarterSums a, const QuarterSums& b) { return a += b; });
  for (const double quarter : all.values(0)) box.value += quarter;
  if (box.records.size() < kLeastRecords) return;
  double best = 0;
  for (int side = 0; side < 4; ++side)
    if (const double gained = gain(box, all, side); gained > best) best = gained, box.side = side;
  if (!(best > 0)) return;
  box.worth = std::min(best, most_worth);
  halve(box, sums, all.below(EmissionBox::slot(box.side)));
  for_each_half(box, [&](Box& half, bool) { grow(half, box.worth); });
  for (const Box& half : *box.halves) box.boxes_within += 1 + half.boxes_within;
}

/// Writes the worths of all boxes that are halved, from `at` on.
void put_worths(Box& box, double* at) {
  if (box.halves == nullptr) return;
  *at++ = box.worth;
  const std::size_t within_lower = (*box.halves)[0].boxes_within / 2;
  for_each_half(box, [&](Box& half, bool upper) { put_worths(half, upper ? at + within_lower : at); });
}

/// Returns a record next to that one, at a place that follows from its numbers.
EmissionRecord beside(const EmissionRecord& record, const EmissionBox& box) {
  std::uint64_t seed = 0;
  for (const float number : record.numbers) seed = mix_bits(seed + std::bit_cast<std::uint32_t>(number));
  const PathRandom random(seed, Stream::setup, 0, 0);
  const Vec2 a = random.pair(0, 0), b = random.pair(0, 1);
  const EmissionNumbers u{a.x, a.y, b.x, b.y};
  EmissionRecord moved = record;
  for (std::size_t side = 0; side < 4; ++side) {
    const float to = record.numbers[side] + (2 * u[side] - 1) * kFarthestBeside * box.size[side];
    moved.numbers[side] = std::clamp(to < 0 ? -to : to < 1 ? to : 2 - to, 0.f, 1 - 0x1p-24f);
  }
  return moved;
}

/// Writes the box's records to `all`, each with one beside it, and frees the halves.
void spread(Box& box, Records all) {
  if (box.halves != nullptr) {
    for_each_half(box, [&](Box& half, bool) { spread(half, all); });
    box.halves = nullptr;
    return;
  }
  EmissionRecord* to = all.data() + 2 * box.place;  // perhaps of none
  for (const EmissionRecord& record : box.records) {
    *to = record, to++->value *= 1 - kBeside;
    *to = beside(record, box.box), to++->value *= kBeside;
  }
}

class Trees {
 public:
  /// The records and `room`, which has as many, are moved to and fro.
  Trees(Records records, Records room, std::span<const float> usual) : usual_(usual), roots_(usual.size()) {
    for_each_root([&](std::size_t light) {
      const auto before = [](const EmissionRecord& record, std::size_t of) {
        return static_cast<std::size_t>(record.light) < of;
      };
      const auto begin = std::lower_bound(records.begin(), records.end(), light, before),
                 end = std::lower_bound(begin, records.end(), light + 1, before);
      const auto first = static_cast<std::size_t>(begin - records.begin()),
                 count = static_cast<std::size_t>(end - begin);
      roots_[light].records = {begin, end}, roots_[light].room = room.subspan(first, count);
      roots_[light].place = first;
      grow(roots_[light], std::numeric_limits<double>::infinity());
    });
  }

  /// Writes the records, light by light, each with one beside it. Without those the density would fall off a cliff at
  /// the edges of what was found: a path that starts just beyond one is seldom drawn, and its weight is larger by as
  /// much.
  void spread(Records all) {
    for_each_root([&](std::size_t light) { dspm::spread(roots_[light], all); });
  }

  EmissionGuide guide() {
    least_worth_ = most_worth_not_affordable();
    for_each_root([&](std::size_t light) { settle(roots_[light], 0); });
    double drawn = 0;
    std::vector<std::size_t> first_within(roots_.size() + 1, roots_.size());
    for (std::size_t light = 0; light < roots_.size(); ++light) {
      drawn += roots_[light].drawn_within;
      first_within[light + 1] = first_within[light] + roots_[light].boxes_within;
    }
    guided_ = drawn > 0 ? (1 - kDefensive) / drawn : 0;
    std::vector<EmissionGuide::Node> nodes(first_within.back());
    for_each_root([&](std::size_t light) {
      lay(roots_[light], light, first_within[light], static_cast<double>(usual_[light]) * (drawn > 0 ? kDefensive : 1),
          nodes);
    });
    return {static_cast<int>(roots_.size()), std::move(nodes)};
  }

 private:
  template <class Fn>
  void for_each_root(Fn&& fn) {
    parallel_for(static_cast<std::int64_t>(roots_.size()), 1, [&](std::int64_t i) { fn(static_cast<std::size_t>(i)); });
  }

  /// If there are too many boxes, returns the worth up to which boxes stay whole: the variance falls most by halving
  /// the others.
  double most_worth_not_affordable() {
    const std::size_t most = EmissionGuide::kMostCells - std::min(EmissionGuide::kMostCells, roots_.size());
    std::vector<std::size_t> halved{0};  // in the trees before, and in all
    for (const Box& root : roots_) halved.push_back(halved.back() + root.boxes_within / 2);
    if (halved.back() <= most) return 0;
    std::vector<double> worths(halved.back());
    for_each_root([&](std::size_t light) { put_worths(roots_[light], worths.data() + halved[light]); });
    const auto first_left = worths.begin() + static_cast<std::ptrdiff_t>(most);
    std::nth_element(worths.begin(), first_left, worths.end(), std::greater<>());
    return *first_left;
  }
  bool is_halved(const Box& box) const { return box.halves != nullptr && box.worth > least_worth_; }

  /// Lets draws climb from their cells to larger boxes, as paths next to those that were found matter, too.
  void settle(Box& box, double climbs) const {
    box.arriving = box.deviation(), box.drawn_within = 0, box.boxes_within = 0;
    if (is_halved(box)) {
      for_each_half(box, [&](Box& half, bool) { settle(half, kClimbs); });
      box.arriving = 0;
      for (const Box& half : *box.halves) {
        box.arriving += half.arriving * kClimbs;
        box.drawn_within += half.drawn_within, box.boxes_within += 1 + half.boxes_within;
      }
    }
    box.drawn = box.arriving * (1 - climbs);
    box.drawn_within += box.drawn;
  }

  /// Writes node `at`, and the nodes of the boxes within it from `first` on. What is within the lower half comes before
  /// what is within the upper one, so a way down is short in memory as well. `density` is that of what is drawn from
  /// the larger boxes. Frees the halves.
  void lay(Box& box, std::size_t at, std::size_t first, double density, std::vector<EmissionGuide::Node>& nodes) const {
    density += guided_ * box.drawn / box.box.volume();
    nodes[at].probability = density * box.box.volume();
    if (!is_halved(box)) return box.halves.reset();
    nodes[at].first_child = static_cast<int>(first), nodes[at].side = box.side;
    const std::size_t of_upper = first + 2 + (*box.halves)[0].boxes_within;
    for_each_half(
        box, [&](Box& half, bool upper) { lay(half, first + upper, upper ? of_upper : first + 2, density, nodes); });
    box.halves = nullptr;
  }

  std::span<const float> usual_;
  std::vector<Box> roots_;  // by light
  double least_worth_ = 0;  // boxes of more are halved
  double guided_ = 0;       // the probability of what is drawn once
};

}  // namespace

EmissionGuide guide_from(std::span<EmissionRecord> records, std::span<const float> usual, GuideRoom& room) {
  const std::size_t count = 2 * records.size();
  for (Buffer<EmissionRecord>* buffer : {&room.spread, &room.halves}) {
    if (buffer->bytes() < count * sizeof(EmissionRecord)) buffer->refit(2 * count);  // rounds have more and more
    buffer->refit(count);
  }
  Trees(records, Records(room.halves).first(records.size()), usual).spread(room.spread);
  return Trees(room.spread, room.halves, usual).guide();
}

EmissionGuide guide_from(std::span<EmissionRecord> records, std::span<const float> usual) {
  GuideRoom room;
  return guide_from(records, usual, room);
}

}  // namespace dspm
