// What a box of emission numbers holds, by side and quarter of the side: it decides which side is halved.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "dspm/integrators/guiding/emission_tree.h"

namespace dspm {

/// Returns whether the record lies in the upper two quarters of a box's side.
inline bool is_in_upper_half(const EmissionRecord& record, const EmissionBox& box, std::size_t side) {
  return !((record.numbers[side] - box.low[side]) * (4 / box.size[side]) < 2);
}

/// The sums over some records of a box. Its four sides are lanes: each record adds its value to the quarter where it
/// lies, and zero to the others, which costs less than to look up where each side's value goes.
class QuarterSums {
 public:
  QuarterSums() = default;
  QuarterSums(std::span<const EmissionRecord> records, const EmissionBox& box) {
    const Numbers low = std::bit_cast<Numbers>(box.low), scale = 4 / std::bit_cast<Numbers>(box.size);
    Values a0{}, a1{}, a2{}, a3{}, b0{}, b1{}, b2{}, b3{};  // of the first two sides and of the others, by quarter
    Integers below{};
    for (const EmissionRecord& record : records) {
      const Numbers place = (std::bit_cast<Numbers>(record.numbers) - low) * scale;
      const Integers quarter = __builtin_convertvector(place, Integers);
      const auto value = std::bit_cast<Integers>(Values{record.value, record.value});
      const auto add = [&](Integers there, Values& a, Values& b) {
        a += std::bit_cast<Values>(value & __builtin_shufflevector(there, there, 0, 0, 1, 1));
        b += std::bit_cast<Values>(value & __builtin_shufflevector(there, there, 2, 2, 3, 3));
      };
      add(quarter < 1, a0, b0), add(quarter == 1, a1, b1), add(quarter == 2, a2, b2), add(quarter > 2, a3, b3);
      below -= quarter < 2;
    }
    for (std::size_t side = 0; side < 2; ++side) {
      values_[side] = {a0[side], a1[side], a2[side], a3[side]};
      values_[side + 2] = {b0[side], b1[side], b2[side], b3[side]};
    }
    for (std::size_t side = 0; side < 4; ++side) below_[side] = static_cast<std::size_t>(below[side]);
  }
  QuarterSums& operator+=(const QuarterSums& o) {
    for (std::size_t side = 0; side < 4; ++side) {
      for (std::size_t at = 0; at < 4; ++at) values_[side][at] += o.values_[side][at];
      below_[side] += o.below_[side];
    }
    return *this;
  }

  /// By quarter.
  const std::array<double, 4>& values(std::size_t side) const { return values_[side]; }
  /// The number of records in the lower half.
  std::size_t below(std::size_t side) const { return below_[side]; }

 private:
  // Comparisons give integers of -1 and 0.
  using Numbers [[gnu::vector_size(16)]] = float;
  using Integers [[gnu::vector_size(16)]] = std::int32_t;
  using Values [[gnu::vector_size(16)]] = double;

  std::array<std::array<double, 4>, 4> values_{};
  std::array<std::size_t, 4> below_{};
};

}  // namespace dspm
