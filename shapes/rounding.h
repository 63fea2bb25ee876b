// Bounds on rounding errors in float arithmetic, and the neighbours of a float.
#pragma once

#include <bit>
#include <cstdint>

namespace dspm {

/// Bound on the relative error of n successive roundings. [Higham, Accuracy and Stability of Numerical Algorithms, 3.1]
constexpr float gamma_bound(int n) {
  const float x = static_cast<float>(n) * 0x1p-24f;
  return x / (1 - x);
}

/// The next float towards plus infinity; `x` must be finite.
inline float next_up(float x) {
  if (x == 0) return 0x1p-149f;
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return std::bit_cast<float>(x > 0 ? bits + 1 : bits - 1);
}
inline float next_down(float x) { return -next_up(-x); }

}  // namespace dspm
