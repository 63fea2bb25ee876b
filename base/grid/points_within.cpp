#include "dspm/base/grid/points_within.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <bit>

#include "dspm/base/math/simd.h"

namespace dspm {
namespace {

/// The byte shuffle that moves each subset of four lanes to the front.
struct LaneShuffles {
  alignas(16) std::uint8_t bytes[16][16] = {};

  constexpr LaneShuffles() {
    for (std::size_t set = 0; set < 16; ++set) {
      std::size_t to = 0;
      for (std::size_t lane = 0; lane < 4; ++lane)
        if (set >> lane & 1)
          for (std::size_t byte = 0; byte < 4; ++byte) bytes[set][to++] = static_cast<std::uint8_t>(4 * lane + byte);
    }
  }
};
constexpr LaneShuffles kLaneShuffles;

}  // namespace

bool is_supported(DistanceTest test) {
#if defined(__x86_64__)
  return test == DistanceTest::four_lanes || __builtin_cpu_supports("avx512f");
#else
  return test == DistanceTest::four_lanes;
#endif
}

const DistanceTest kWidestDistanceTest =
    is_supported(DistanceTest::sixteen_lanes) ? DistanceTest::sixteen_lanes : DistanceTest::four_lanes;

std::uint32_t PointsWithin::add_four(const float* x, const float* y, const float* z, std::uint32_t begin,
                                     std::uint32_t end) {
  const __m128 px = _mm_set1_ps(p_.x), py = _mm_set1_ps(p_.y), pz = _mm_set1_ps(p_.z);
  const __m128 limit = _mm_set1_ps(radius2_);
  std::uint32_t i = begin, count = count_;
  for (; i < end && count <= kRoom - kMostLanes; i += 4) {
    const __m128 dx = _mm_sub_ps(_mm_loadu_ps(x + i), px), dy = _mm_sub_ps(_mm_loadu_ps(y + i), py),
                 dz = _mm_sub_ps(_mm_loadu_ps(z + i), pz);
    const __m128 d2 = _mm_add_ps(_mm_add_ps(_mm_mul_ps(dx, dx), _mm_mul_ps(dy, dy)), _mm_mul_ps(dz, dz));
    auto within = static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(d2, limit)));
    if (end - i < 4) within &= (1u << (end - i)) - 1;
    const __m128i numbers = _mm_add_epi32(_mm_set1_epi32(static_cast<int>(i)), _mm_setr_epi32(0, 1, 2, 3));
    const __m128i together = _mm_load_si128(reinterpret_cast<const __m128i*>(kLaneShuffles.bytes[within]));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(numbers_ + count), _mm_shuffle_epi8(numbers, together));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(distance2_ + count), _mm_shuffle_epi8(_mm_castps_si128(d2), together));
    count += static_cast<std::uint32_t>(std::popcount(within));
  }
  count_ = count;
  return i;
}

#if defined(__x86_64__)
__attribute__((target("avx512f"))) std::uint32_t PointsWithin::add_sixteen(const float* x, const float* y,
                                                                           const float* z, std::uint32_t begin,
                                                                           std::uint32_t end) {
  const __m512 px = _mm512_set1_ps(p_.x), py = _mm512_set1_ps(p_.y), pz = _mm512_set1_ps(p_.z);
  const __m512 limit = _mm512_set1_ps(radius2_);
  const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  std::uint32_t i = begin, count = count_;
  for (; i < end && count <= kRoom - kMostLanes; i += 16) {
    const __m512 dx = _mm512_sub_ps(_mm512_loadu_ps(x + i), px), dy = _mm512_sub_ps(_mm512_loadu_ps(y + i), py),
                 dz = _mm512_sub_ps(_mm512_loadu_ps(z + i), pz);
    const __m512 d2 = _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy)), _mm512_mul_ps(dz, dz));
    __mmask16 within = _mm512_cmp_ps_mask(d2, limit, _CMP_LE_OQ);
    if (end - i < 16) within = static_cast<__mmask16>(within & ((1u << (end - i)) - 1));
    const __m512i numbers = _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(i)), lanes);
    _mm512_storeu_si512(numbers_ + count, _mm512_maskz_compress_epi32(within, numbers));
    _mm512_storeu_ps(distance2_ + count, _mm512_maskz_compress_ps(within, d2));
    count += static_cast<std::uint32_t>(std::popcount(static_cast<unsigned>(within)));
  }
  count_ = count;
  return i;
}
#else
std::uint32_t PointsWithin::add_sixteen(const float* x, const float* y, const float* z, std::uint32_t begin,
                                        std::uint32_t end) {
  return add_four(x, y, z, begin, end);
}
#endif

}  // namespace dspm
