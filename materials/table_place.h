// A place in a table over [0, 1] whose entries lie closer at small values: between which two, and how far.
#pragma once

#include <algorithm>

#include "dspm/base/math/rounded.h"

namespace dspm {

struct TablePlace {
  int first;
  float fraction;

  constexpr TablePlace(float value, int count) {
    const float x = rounded::sqrt(std::clamp(value, 0.f, 1.f)) * static_cast<float>(count - 1);
    first = std::min(static_cast<int>(x), count - 2), fraction = x - static_cast<float>(first);
  }
  /// The value of an entry.
  static constexpr float value(int i, int count) {
    const float x = static_cast<float>(i) / static_cast<float>(count - 1);
    return x * x;
  }
  constexpr float between(float a, float b) const { return a + fraction * (b - a); }
};

}  // namespace dspm
