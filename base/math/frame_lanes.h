// Frames side by side in SIMD lanes: group g holds frames 4 g to 4 g + 3.
#pragma once

#include "dspm/base/math/frames.h"
#include "dspm/base/math/simd.h"

namespace dspm {

/// Returns lanes in which all bits are set for frames in the set, and none for the others.
inline __m128 lanes_of(FrameSet frames, int group) {
  const __m128i bit = _mm_setr_epi32(1, 2, 4, 8);
  const __m128i bits = _mm_set1_epi32(static_cast<int>(frames.bits() >> 4 * group & 15));
  return _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(bits, bit), bit));
}

/// Calls fn(group, lanes) for each group that holds any of `frames`.
template <class Fn>
void for_each_group(FrameSet frames, Fn&& fn) {
  for (std::uint64_t rest = frames.bits(); rest != 0;) {
    const int group = std::countr_zero(rest) / 4;
    rest &= ~(std::uint64_t{15} << 4 * group);
    fn(group, lanes_of(frames, group));
  }
}

}  // namespace dspm
