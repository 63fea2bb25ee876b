// Placements that have no inverse.
#pragma once

#include "dspm/base/math/transform.h"

namespace dspm {

inline constexpr Matrix4 kZeroMatrix{{{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}}};

/// Returns whether the matrix makes a point of everything: a scale of 0, by which exporters hide things. Keys that go
/// from a scale to its opposite pass through it, up to rounding.
inline bool vanishes(const Matrix4& matrix) {
  constexpr double kNothing = 1e-15;
  if (!matrix.is_affine()) return false;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (!(matrix.m[i][j] <= kNothing && matrix.m[i][j] >= -kNothing)) return false;
  return true;
}

}  // namespace dspm
