// Places in a box by their order along a curve through space, so that what is close along it is close in space.
// [Morton 1966]
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>

#include "dspm/base/math/vec.h"

namespace dspm {

inline constexpr int kZCurveBits = 63;  // of a place along the curve

/// The place of a point of the box: the interleaved bits of its coordinates.
inline std::uint64_t place_along_z_curve(const Vec3& p, const Bounds3& box) {
  constexpr int kMost = (1 << kZCurveBits / 3) - 1;
  const auto spread = [](std::uint64_t v) {  // the lowest 21 bits, with two zeros after each
    v = (v | v << 32) & 0x001f00000000ffffu;
    v = (v | v << 16) & 0x001f0000ff0000ffu;
    v = (v | v << 8) & 0x100f00f00f00f00fu;
    v = (v | v << 4) & 0x10c30c30c30c30c3u;
    return (v | v << 2) & 0x1249249249249249u;
  };
  std::uint64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float share = (p[axis] - box.low[axis]) / (box.high[axis] - box.low[axis]);
    place |= spread(static_cast<std::uint64_t>(std::clamp(share > 0 ? share : 0, 0.f, 1.f) * kMost)) << axis;
  }
  return place;
}

/// What lies at a place along the curve, by its number. Things at the same place are in the order of their numbers.
struct AlongZCurve {
  std::uint64_t place;
  std::uint32_t number;
  friend auto operator<=>(const AlongZCurve&, const AlongZCurve&) = default;
};

}  // namespace dspm
