// Numbers in [0, 1] in two bytes each, more exact the smaller they are: a Bsdf has little room.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "dspm/colour/rgb.h"

namespace dspm {

class SmallNumber {
 public:
  explicit SmallNumber(float value)
      : root_(static_cast<std::uint16_t>(std::lround(std::sqrt(std::clamp(value, 0.f, 1.f)) * kMost))) {}
  operator float() const {
    const float root = static_cast<float>(root_) / kMost;
    return root * root;
  }
  friend bool operator==(SmallNumber a, SmallNumber b) { return a.root_ == b.root_; }

 private:
  static constexpr float kMost = 65535;
  std::uint16_t root_;
};

struct SmallRgb {
  SmallNumber r, g, b;
  explicit SmallRgb(const Rgb& c) : r(c.r), g(c.g), b(c.b) {}
  operator Rgb() const { return {r, g, b}; }
  friend bool operator==(const SmallRgb& a, const SmallRgb& b) { return a.r == b.r && a.g == b.g && a.b == b.b; }
};

}  // namespace dspm
