// Numbers in [0, 1] in two bytes each, more exact the smaller they are, and directions in four: a Bsdf has little room.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"

namespace dspm {

class SmallNumber {
 public:
  constexpr explicit SmallNumber(float value) : root_(nearest(rounded::sqrt(std::clamp(value, 0.f, 1.f)) * kMost)) {}
  constexpr operator float() const {
    const float root = static_cast<float>(root_) / kMost;
    return root * root;
  }
  friend constexpr bool operator==(SmallNumber a, SmallNumber b) { return a.root_ == b.root_; }

 private:
  static constexpr float kMost = 65535;
  static constexpr std::uint16_t nearest(float x) {
    const int below = static_cast<int>(x);
    return static_cast<std::uint16_t>(x - static_cast<float>(below) < 0.5f ? below : below + 1);
  }
  std::uint16_t root_;
};

class SmallSpectrum {
 public:
  explicit SmallSpectrum(const Spectrum& s) : v_{SmallNumber(s[0]), SmallNumber(s[1]), SmallNumber(s[2])} {}
  operator Spectrum() const { return {v_[0], v_[1], v_[2]}; }
  friend bool operator==(const SmallSpectrum&, const SmallSpectrum&) = default;

 private:
  std::array<SmallNumber, 3> v_;
};

/// A unit vector, to 5e-5, on an octahedron whose lower half is folded out; those of the axes are exact.
class SmallDirection {
 public:
  explicit SmallDirection(const Vec3& d) {
    const float sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    const float x = d.x / sum, y = d.y / sum;
    x_ = whole(d.z < 0 ? fold(x, y) : x), y_ = whole(d.z < 0 ? fold(y, x) : y);
  }
  operator Vec3() const {
    const float x = static_cast<float>(x_) / kMost, y = static_cast<float>(y_) / kMost;
    const float z = 1 - std::abs(x) - std::abs(y);
    return normalize(z < 0 ? Vec3{fold(x, y), fold(y, x), z} : Vec3{x, y, z});
  }
  friend bool operator==(SmallDirection a, SmallDirection b) { return a.x_ == b.x_ && a.y_ == b.y_; }

 private:
  static constexpr float kMost = 32767;
  static std::int16_t whole(float x) { return static_cast<std::int16_t>(std::lround(x * kMost)); }
  static float fold(float a, float b) { return std::copysign(1 - std::abs(b), a); }
  std::int16_t x_, y_;
};

}  // namespace dspm
