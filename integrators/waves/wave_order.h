// The order of what the steps of waves leave, in no order of their own.
#pragma once

#include <cstdint>

#include "dspm/base/math/frames.h"

namespace dspm {

/// Returns a number that grows with path, bounce, `which` (below 4) and lowest frame, in this order.
constexpr std::uint64_t wave_order(std::uint32_t path, std::uint16_t bounces, FrameSet frames, unsigned which) {
  const auto lowest = static_cast<std::uint64_t>(frames.lowest());
  return static_cast<std::uint64_t>(path) << 24 | static_cast<std::uint64_t>(bounces) << 8 |
         static_cast<std::uint64_t>(which) << 6 | lowest;
}

}  // namespace dspm
