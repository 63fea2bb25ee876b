// Elementary functions in double, with a relative error below 2^-48, by additions, multiplications, divisions and square
// roots alone: a processor, a GPU and the compiler itself compute the same bits. A C library's functions differ between
// versions, processors and devices. rounded.h makes functions of floats from these.
//
// The polynomials interpolate at Chebyshev's points; the reductions of arguments are those of [Muller 2016, Elementary
// Functions].
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace dspm::elementary {

inline constexpr double kPi = 3.14159265358979323846, kLn2 = 0.693147180559945309417, kLog2OfE = 1.44269504088896340736;

/// Returns the sum of c[i] x^i. Pairs are summed side by side, which a processor does sooner than one after the other.
/// [Estrin 1960]
template <std::size_t N>
constexpr double polynomial(double x, const double (&c)[N]) {
  if constexpr (N == 1) {
    return c[0];
  } else {
    double pairs[(N + 1) / 2];
    for (std::size_t i = 0; i < N / 2; ++i) pairs[i] = c[2 * i] + c[2 * i + 1] * x;
    if (N % 2 != 0) pairs[N / 2] = c[N - 1];
    return polynomial(x * x, pairs);
  }
}

/// Returns the nearest whole number if |x| < 2^51.
constexpr double nearest(double x) { return x + 0x1.8p52 - 0x1.8p52; }

/// Correctly rounded, but for what the compiler computes.
constexpr double sqrt(double x) {
  if (!std::is_constant_evaluated()) return __builtin_sqrt(x);
  if (!(x > 0) || x == x * 2) return x < 0 ? std::numeric_limits<double>::quiet_NaN() : x;
  double root = std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) >> 1) + (std::uint64_t{1023} << 51));
  for (int i = 0; i < 6; ++i) root = 0.5 * (root + x / root);  // [Heron]
  return root;
}

constexpr double hypot(double x, double y) { return sqrt(x * x + y * y); }
constexpr double copysign(double size, double sign) { return __builtin_copysign(size, sign); }

struct SinCos {
  double sin, cos;
};

/// An angle as `rest`, at most pi / 4 from zero, and whole quarters of a turn.
struct Octant {
  double rest;
  std::int64_t quarters;

  constexpr SinCos sin_cos() const {
    const double z = rest * rest;
    const double s = rest + rest * z *
                                polynomial(z, {-0x1.5555555555555p-3, 0x1.1111111110bb1p-7, -0x1.a01a019e8357dp-13,
                                               0x1.71de37961e4c6p-19, -0x1.ae600a926c89ap-26, 0x1.5e0af186af739p-33});
    const double c = 1 - 0.5 * z +
                     z * z *
                         polynomial(z, {0x1.5555555555437p-5, -0x1.6c16c16b612abp-10, 0x1.a019ff534c684p-16,
                                        -0x1.27e25f0776cc1p-22, 0x1.1c81a3b8d462fp-29});
    const SinCos turned = quarters % 2 == 0 ? SinCos{s, c} : SinCos{c, s};
    return {(quarters & 2) != 0 ? -turned.sin : turned.sin, ((quarters + 1) & 2) != 0 ? -turned.cos : turned.cos};
  }
};

/// Returns 64 bits of 2 / pi, from that many behind its point on; at most 192.
constexpr std::uint64_t bits_of_two_over_pi(int from) {
  const auto word = [](int i) {
    return i == 0   ? 0xa2f9836e4e441529u
           : i == 1 ? 0xfc2757d1f534ddc0u
           : i == 2 ? 0xdb6295993c439041u
                    : 0xfe5163abdebbc561u;
  };
  const int i = from / 64, shift = from % 64;
  return shift == 0 ? word(i) : word(i) << shift | word(i + 1) >> (64 - shift);
}

/// Takes |x| < 2^25.
constexpr Octant octant(double x) {
  constexpr double kHigh = 0x1.921fb54p+0, kMiddle = 0x1.10b4610p-30, kLow = 0x1.a62633145c06ep-58;  // of pi / 2
  const double n = nearest(x * (2 / kPi));  // its products with the first two are exact
  return {x - n * kHigh - n * kMiddle - n * kLow, static_cast<std::int64_t>(n)};
}
constexpr SinCos sin_cos(double x) { return octant(x).sin_cos(); }

/// Takes any finite float. [Payne and Hanek 1983] for large ones: bits of x / (2 pi) that are whole turns are left out.
constexpr Octant octant(float x) {
  if (-0x1p25f < x && x < 0x1p25f) return octant(double{x});
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  const std::uint64_t digits = (bits & 0x7fffffu) | 0x800000u;
  const int skipped = static_cast<int>(bits >> 23 & 0xff) - 127 - 23 - 2;
  const std::uint64_t turns =  // in 2^-64
      digits * bits_of_two_over_pi(skipped) + (digits * (bits_of_two_over_pi(skipped + 64) >> 32) >> 32);
  const std::uint64_t quarters = (turns + (std::uint64_t{1} << 61)) >> 62;
  const double rest = static_cast<double>(static_cast<std::int64_t>(turns - (quarters << 62))) * (kPi / 2 * 0x1p-62);
  const auto whole = static_cast<std::int64_t>(quarters);
  return x < 0 ? Octant{-rest, -whole} : Octant{rest, whole};
}

/// Takes |x| < 700.
constexpr double exp(double x) {
  constexpr double kHigh = 0x1.62e42fep-1, kLow = 0x1.f473de6af278fp-30;  // of ln 2
  const double n = nearest(x * kLog2OfE), r = x - n * kHigh - n * kLow;
  const double fraction = 1 + r +
                          r * r *
                              polynomial(r, {0x1p-1, 0x1.5555555553b78p-3, 0x1.5555555554cb7p-5, 0x1.1111111c478ebp-7,
                                             0x1.6c16c1738ff55p-10, 0x1.a019ada3609f3p-13, 0x1.a019c9a5652d3p-16,
                                             0x1.72c72ca338df0p-19, 0x1.2880411bad1aap-22});
  return fraction * std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(n) + 1023) << 52);
}

/// Returns the logarithm of (1 + s) / (1 - s), for |s| < 0.1716.
constexpr double log_of_ratio(double s) {
  const double w = s * s;
  return 2 * s +
         s * w *
             polynomial(w, {0x1.5555555555558p-1, 0x1.99999999952d7p-2, 0x1.2492492df281ap-2, 0x1.c71c62e3f11e6p-3,
                            0x1.7462b51cb66b1p-3, 0x1.39fe51a7c18f9p-3, 0x1.2b5900de53b32p-3});
}

/// Takes positive normal numbers.
constexpr double log(double x) {
  // x = 2^n m, with m between the roots of 1/2 and 2, whose bits differ from those of 1 by less than half an exponent.
  constexpr std::uint64_t kRootOfHalf = 0x3fe6a09e667f3bcd;
  const std::uint64_t beyond = std::bit_cast<std::uint64_t>(x) - kRootOfHalf;
  const auto n = static_cast<std::int64_t>(beyond) >> 52;
  const double m = std::bit_cast<double>((beyond & 0xfffffffffffffu) + kRootOfHalf);
  return static_cast<double>(n) * kLn2 + log_of_ratio((m - 1) / (m + 1));
}

/// Returns the angle from the x axis to (x, y), for finite numbers that are not negative; 0 at the origin.
constexpr double first_quadrant_angle(double y, double x) {
  const bool steep = y > x;
  const double small = steep ? x : y, large = steep ? y : x;
  if (large == 0) return 0;
  // tan(a - pi / 4) = (tan a - 1) / (tan a + 1)
  const bool wide = small > 0.41421356237309503 * large;
  const double t = wide ? (small - large) / (small + large) : small / large, w = t * t;
  const double angle =
      t + t * w *
              polynomial(w, {-0x1.5555555555546p-2, 0x1.9999999990a81p-3, -0x1.2492491dd36fep-3, 0x1.c71c6dd12673dp-4,
                             -0x1.745c7f6f74ddep-4, 0x1.3b068d86c9c53p-4, -0x1.105e316e925c8p-4, 0x1.d5eaddccfafaep-5,
                             -0x1.6f43e8bd8d90ap-5, 0x1.74b7f80f108e5p-6});
  const double from_axis = wide ? angle + kPi / 4 : angle;
  return steep ? kPi / 2 - from_axis : from_axis;
}

/// Takes finite numbers; signs of zeros count, as in C.
constexpr double atan2(double y, double x) {
  const double angle = first_quadrant_angle(copysign(y, 1), copysign(x, 1));
  return copysign(copysign(1, x) < 0 ? kPi - angle : angle, y);
}
/// Takes numbers from -1 to 1.
constexpr double acos(double x) { return atan2(sqrt((1 - x) * (1 + x)), x); }

}  // namespace dspm::elementary
