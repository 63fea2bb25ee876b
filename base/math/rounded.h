// Functions of floats: the float nearest to the value in all but one of millions of cases, and next to it in those. So
// images have the same bits whatever the C library, the processor or the device. Zeros, infinities and NaN are as in C.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "dspm/base/math/elementary.h"

namespace dspm::rounded {

inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

constexpr bool is_negative(float x) { return std::bit_cast<std::uint32_t>(x) >> 31 != 0; }
constexpr float with_sign_of(float sign, double size) { return static_cast<float>(is_negative(sign) ? -size : size); }

constexpr float sqrt(float x) {
  return std::is_constant_evaluated() ? static_cast<float>(elementary::sqrt(double{x})) : __builtin_sqrtf(x);
}
/// Returns the greatest whole number that is not above x.
constexpr float floor(float x) {
  if (!std::is_constant_evaluated()) return __builtin_floorf(x);
  if (!(x > -0x1p23f && x < 0x1p23f) || x == 0) return x;  // whole, or not a number
  const auto towards_zero = static_cast<float>(static_cast<std::int32_t>(x));
  return towards_zero > x ? towards_zero - 1 : with_sign_of(x, std::abs(double{towards_zero}));
}
/// Returns the square root of x^2 + y^2.
constexpr float hypot(float x, float y) { return static_cast<float>(elementary::hypot(x, y)); }

struct SinCos {
  float sin, cos;
};
constexpr SinCos sin_cos(float x) {
  if (!(x - x == 0)) return {kNaN, kNaN};
  const elementary::SinCos exact = elementary::octant(x).sin_cos();
  return {x == 0 ? x : static_cast<float>(exact.sin), static_cast<float>(exact.cos)};
}
constexpr float sin(float x) { return sin_cos(x).sin; }
constexpr float cos(float x) { return sin_cos(x).cos; }
constexpr float tan(float x) {
  if (!(x - x == 0)) return kNaN;
  const elementary::SinCos exact = elementary::octant(x).sin_cos();
  return x == 0 ? x : static_cast<float>(exact.sin / exact.cos);
}

constexpr float atan2(float y, float x) {
  if (x != x || y != y) return kNaN;
  const double up = std::abs(y), along = std::abs(x);
  const bool endless = up > double{std::numeric_limits<float>::max()};
  const double angle = endless && up == along ? elementary::kPi / 4
                       : endless              ? elementary::kPi / 2
                                              : elementary::first_quadrant_angle(up, along);
  return with_sign_of(y, is_negative(x) ? elementary::kPi - angle : angle);
}
constexpr float atan(float x) { return atan2(x, 1); }
constexpr float asin(float x) {
  if (!(x >= -1 && x <= 1)) return kNaN;
  return with_sign_of(
      x, elementary::first_quadrant_angle(std::abs(double{x}), elementary::sqrt((1 - double{x}) * (1 + double{x}))));
}
constexpr float acos(float x) { return x >= -1 && x <= 1 ? static_cast<float>(elementary::acos(x)) : kNaN; }

constexpr float exp(float x) {  // beyond these bounds, the results are infinity and 0
  return x != x ? x : static_cast<float>(elementary::exp(std::clamp(double{x}, -110., 90.)));
}

constexpr double log_in_double(double x) {
  if (x != x || x < 0) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0) return -std::numeric_limits<double>::infinity();
  return x > std::numeric_limits<double>::max() ? x : elementary::log(x);
}
constexpr float log(float x) { return static_cast<float>(log_in_double(double{x})); }
constexpr float log2(float x) { return static_cast<float>(log_in_double(double{x}) * elementary::kLog2OfE); }
/// Returns log(1 + x), also if 1 + x has few digits of x.
constexpr float log1p(float x) {
  if (x == 0) return x;
  const bool near = -0.25f < x && x < 0.375f;
  return static_cast<float>(near ? elementary::log_of_ratio(double{x} / (2 + double{x}))
                                 : log_in_double(1 + double{x}));
}

constexpr float cbrt(float x) {
  if (x == 0 || !(x - x == 0)) return x;
  return with_sign_of(x, elementary::exp(elementary::log(std::abs(double{x})) / 3));
}

constexpr float pow(float x, float y) {
  if (y == 0 || x == 1) return 1;
  if (x != x || y != y) return kNaN;
  const double base = std::abs(double{x}), size = std::abs(double{y}),
               infinity = std::numeric_limits<double>::infinity();
  const bool whole = size >= 0x1p23 || static_cast<double>(static_cast<std::int32_t>(size)) == size;
  const bool odd = size < 0x1p24 && whole && (static_cast<std::int32_t>(size) & 1) != 0;
  if (x < 0 && !whole && base < infinity) return kNaN;
  const float sign = odd ? x : 1.f;
  if (size == infinity && base == 1) return 1;
  if (base == 0 || base == infinity || size == infinity)
    return with_sign_of(sign, (base > 1) == (y > 0) ? infinity : 0);
  return with_sign_of(sign, elementary::exp(std::clamp(elementary::log(base) * double{y}, -110., 90.)));
}

}  // namespace dspm::rounded
