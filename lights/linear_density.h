// A density on [0, 1) that is linear, and what is drawn from it. [Pharr, Jakob, Humphreys, Physically Based Rendering,
// 4th ed., A.4.1]
#pragma once

#include <algorithm>
#include <cmath>

namespace dspm {

/// Draws in proportion to a at 0 and b at 1, neither below 0, from a uniform number; uniformly if both are 0.
inline float sample_linear(float u, float a, float b) {
  if (!(a + b > 0) || u == 0) return u;
  return std::min(u * (a + b) / (a + std::sqrt(a * a + u * (b * b - a * a))), 1.f);
}
/// Returns the u with sample_linear(u, a, b) = x.
inline float linear_number(float x, float a, float b) { return a + b > 0 ? x * (2 * a + (b - a) * x) / (a + b) : x; }

}  // namespace dspm
