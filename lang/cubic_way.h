// A cubic curve through values at keys, in time: Hermite's on each section, with the slopes of a Catmull-Rom spline
// unless others are given.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace dspm {

/// Up to 16 numbers, of which some belong together: the coordinates of a point, for example.
using Numbers = std::array<double, 16>;

/// Numbers that stand still together if they are the same at two keys.
struct Quantity {
  std::size_t first, count;
};

/// Keys through which one curve goes. If it `loops`, the section after the last key is the first one again.
struct CubicRun {
  std::size_t first, last;
  bool loops = false;
};

/// `value(key)` are Numbers, `moment(key)` their time in frames, `given(key, argument, leaves)` an optional slope of one
/// of them before or after the key.
template <class Value, class MomentOf, class Given>
class CubicWay {
 public:
  CubicWay(const CubicRun& run, Value value, MomentOf moment, Given given)
      : run_(run), value_(value), moment_(moment), given_(given) {}

  /// From `key` (t = 0) to the next (t = 1).
  Numbers at(std::size_t key, double t, const Quantity& quantity) const {
    const Numbers from = value_(key), to = value_(key + 1), out = slopes(key, true, quantity),
                  in = slopes(key + 1, false, quantity);
    const double length = moment_(key + 1) - moment_(key);
    Numbers result = from;
    for (std::size_t i = quantity.first; i < quantity.first + quantity.count; ++i)
      result[i] += (3 - 2 * t) * t * t * (to[i] - from[i]) +
                   t * (1 - t) * length * ((1 - t) * out[i] - t * in[i]);  // both are exactly 0 where nothing moves
    return result;
  }

 private:
  /// The mean slopes of the section that begins at `key`, and its length.
  struct Section {
    Numbers slopes{};
    double length;
    bool is_still = true;
  };
  Section section(std::size_t key, const Quantity& quantity) const {
    const Numbers from = value_(key), to = value_(key + 1);
    Section section{{}, moment_(key + 1) - moment_(key)};
    for (std::size_t i = quantity.first; i < quantity.first + quantity.count; ++i) {
      section.slopes[i] = (to[i] - from[i]) / section.length;
      if (to[i] != from[i]) section.is_still = false;
    }
    return section;
  }

  Numbers slopes(std::size_t key, bool leaves, const Quantity& quantity) const {
    Numbers result = own_slopes(key, quantity);
    for (std::size_t i = quantity.first; i < quantity.first + quantity.count; ++i)
      if (const std::optional<double> slope = given_(key, i, leaves)) result[i] = *slope;
    return result;
  }

  /// Those at the key of the parabola through it and its neighbours; at an end, of the parabola through the last three.
  /// Zero beside a section in which nothing moves.
  Numbers own_slopes(std::size_t key, const Quantity& quantity) const {
    const bool is_first = key == run_.first, is_last = key == run_.last;
    const std::size_t before = is_first ? run_.last - 1 : key - 1, after = is_last ? run_.first : key;
    if ((is_first || is_last) && !run_.loops) return end_slopes(key, quantity);
    const Section in = section(before, quantity), out = section(after, quantity);
    Numbers result{};
    if (in.is_still || out.is_still) return result;
    for (std::size_t i = quantity.first; i < quantity.first + quantity.count; ++i)
      result[i] = (out.length * in.slopes[i] + in.length * out.slopes[i]) / (in.length + out.length);
    return result;
  }

  Numbers end_slopes(std::size_t key, const Quantity& quantity) const {
    const bool is_first = key == run_.first;
    const Section only = section(is_first ? key : key - 1, quantity);
    if (only.is_still || run_.last - run_.first == 1) return only.slopes;
    const Numbers next = own_slopes(is_first ? key + 1 : key - 1, quantity);
    Numbers result{};
    for (std::size_t i = quantity.first; i < quantity.first + quantity.count; ++i)
      result[i] = 2 * only.slopes[i] - next[i];
    return result;
  }

  CubicRun run_;
  Value value_;
  MomentOf moment_;
  Given given_;
};

}  // namespace dspm
