// Bounds on rounding errors in float arithmetic.
#pragma once

namespace dspm {

/// Bound on the relative error of n successive roundings. [Higham, Accuracy and Stability of Numerical Algorithms, 3.1]
constexpr float gamma_bound(int n) {
  const float x = static_cast<float>(n) * 0x1p-24f;
  return x / (1 - x);
}

}  // namespace dspm
