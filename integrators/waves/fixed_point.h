// Sums of numbers in fixed point: they are the same in whatever order the numbers come.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace dspm {

/// Numbers in units of 2^-53 of the power of two above `most`; sums may be up to a thousand times as large.
class FixedPoint {
 public:
  explicit FixedPoint(double most) {
    int exponent = 0;
    std::frexp(most, &exponent);
    per_unit_ = std::ldexp(1., std::clamp(53 - exponent, -1000, 1000));
  }

  constexpr std::int64_t of(double number) const {
    const double units = number * per_unit_;
    return static_cast<std::int64_t>(units < 0 ? units - 0.5 : units + 0.5);
  }
  constexpr double number(std::int64_t sum) const { return static_cast<double>(sum) / per_unit_; }

 private:
  double per_unit_;
};

}  // namespace dspm
