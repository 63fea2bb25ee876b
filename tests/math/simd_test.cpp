// What the functions of base/math/simd.h do with NaN, zeros, signs and the order of sums: the same on every processor.
#include "dspm/base/math/simd.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dspm {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

using FourFloats = std::array<float, 4>;
using FourWords = std::array<std::uint32_t, 4>;

/// Values that the compiler does not know.
__m128 unknown(float a, float b, float c, float d) {
  alignas(16) volatile float values[4] = {a, b, c, d};
  return _mm_setr_ps(values[0], values[1], values[2], values[3]);
}
__m128i unknown_bytes(const std::array<std::uint8_t, 16>& bytes) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes.data()));
}

FourFloats floats(__m128 lanes) {
  FourFloats values;
  _mm_storeu_ps(values.data(), lanes);
  return values;
}
FourWords words(__m128 lanes) {
  FourWords values;
  _mm_storeu_si128(reinterpret_cast<__m128i*>(values.data()), _mm_castps_si128(lanes));
  return values;
}

TEST(Simd, MinAndMaxReturnTheSecondIfOneIsNanOrBothAreZero) {
  const __m128 a = unknown(kNan, 1, 0.f, -0.f), b = unknown(1, kNan, -0.f, 0.f);
  for (const FourFloats& of : {floats(_mm_min_ps(a, b)), floats(_mm_max_ps(a, b))}) {
    EXPECT_EQ(of[0], 1);
    EXPECT_TRUE(std::isnan(of[1]));
    EXPECT_TRUE(std::signbit(of[2]));
    EXPECT_FALSE(std::signbit(of[3]));
  }
  EXPECT_EQ(floats(_mm_min_ps(unknown(1, 2, -3, 4), unknown(2, 1, 3, -4))), (FourFloats{1, 1, -3, -4}));
  EXPECT_EQ(floats(_mm_max_ps(unknown(1, 2, -3, 4), unknown(2, 1, 3, -4))), (FourFloats{2, 2, 3, 4}));
}

TEST(Simd, MinAndMaxOfOneLaneKeepTheOthersOfTheFirst) {
  const __m128 a = unknown(1, 2, 3, 4), b = unknown(0, 9, 9, 9);
  EXPECT_EQ(floats(_mm_min_ss(a, b)), (FourFloats{0, 2, 3, 4}));
  EXPECT_EQ(floats(_mm_max_ss(b, a)), (FourFloats{1, 9, 9, 9}));
}

// (1 + e) + (e + e) with e half of the last bit of 1: from left to right it would be 1.
TEST(Simd, ADotProductAddsPairsFirst) {
  const float e = std::ldexp(1.f, -24);
  EXPECT_EQ(_mm_cvtss_f32(_mm_dp_ps(unknown(1, e, e, e), unknown(1, 1, 1, 1), 0xf1)), 1 + 2 * e);
}

TEST(Simd, ADotProductIgnoresLanesThatAreNotAskedFor) {
  const __m128 product = _mm_dp_ps(unknown(1, 2, 3, kNan), unknown(4, 5, 6, 0), 0x71);
  EXPECT_EQ(floats(product), (FourFloats{32, 0, 0, 0}));
}

TEST(Simd, ComparisonsWithNan) {
  const __m128 a = unknown(kNan, 1, kNan, 1), b = unknown(1, kNan, kNan, 1);
  EXPECT_EQ(_mm_movemask_ps(_mm_cmplt_ps(a, b)), 0);
  EXPECT_EQ(_mm_movemask_ps(_mm_cmpgt_ps(a, b)), 0);
  EXPECT_EQ(_mm_movemask_ps(_mm_cmple_ps(a, b)), 8);
  EXPECT_EQ(_mm_movemask_ps(_mm_cmpge_ps(a, b)), 8);
  EXPECT_EQ(_mm_movemask_ps(_mm_cmpeq_ps(a, b)), 8);
  EXPECT_EQ(_mm_movemask_ps(_mm_cmpneq_ps(a, b)), 7);
  EXPECT_EQ(_mm_movemask_ps(_mm_cmpunord_ps(a, b)), 7);
  EXPECT_EQ(words(_mm_cmpneq_ps(a, b)), (FourWords{~0u, ~0u, ~0u, 0}));
}

TEST(Simd, AMaskIsTheSignBits) {
  EXPECT_EQ(_mm_movemask_ps(unknown(-0.f, 0, -1, 1)), 5);
  EXPECT_EQ(_mm_movemask_ps(unknown(std::copysign(kNan, -1.f), std::copysign(kNan, 1.f), 0, -kNan)) & 7, 1);
}

TEST(Simd, BlendingTakesTheSecondWhereTheMaskHasASign) {
  const __m128 blended = _mm_blendv_ps(unknown(1, 2, 3, 4), unknown(5, 6, 7, 8), unknown(-0.f, 1, -1, kNan));
  EXPECT_EQ(floats(blended), (FourFloats{5, 2, 7, 4}));
}

TEST(Simd, LanesThatMove) {
  const __m128 a = unknown(0, 1, 2, 3), b = unknown(4, 5, 6, 7);
  EXPECT_EQ(floats(_mm_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 3, 1))), (FourFloats{1, 3, 4, 6}));
  EXPECT_EQ(floats(_mm_movelh_ps(a, b)), (FourFloats{0, 1, 4, 5}));
  EXPECT_EQ(floats(_mm_movehl_ps(a, b)), (FourFloats{6, 7, 2, 3}));
}

TEST(Simd, ByteShufflesPutZeroForNegativePlaces) {
  const __m128i bytes = unknown_bytes({10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25});
  const __m128i to = unknown_bytes({15, 0, 0x80, 0xff, 7, 7, 8, 9, 0, 0, 0, 0, 0, 0, 0, 0x81});
  std::array<std::uint8_t, 16> shuffled;
  _mm_storeu_si128(reinterpret_cast<__m128i*>(shuffled.data()), _mm_shuffle_epi8(bytes, to));
  EXPECT_EQ(shuffled, (std::array<std::uint8_t, 16>{25, 10, 0, 0, 17, 17, 18, 19, 10, 10, 10, 10, 10, 10, 10, 0}));
}

TEST(Simd, DoublesAreRoundedToTheNearestFloat) {
  const double half = std::ldexp(1., -24);
  const __m128 rounded = _mm_cvtpd_ps(_mm_setr_pd(1 + half, 1 + 3 * half));
  EXPECT_EQ(floats(rounded), (FourFloats{1, static_cast<float>(1 + 4 * half), 0, 0}));
}

TEST(Simd, SubnormalNumbersAreKept) {
  const float least = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(floats(_mm_mul_ps(unknown(least, 2, 1e-20f, 0), unknown(1, least, 1e-20f, 0))),
            (FourFloats{least, 2 * least, 1e-20f * 1e-20f, 0}));
}

// A fused multiplication and addition would keep 2^-24.
TEST(Simd, ProductsAreRoundedBeforeTheyAreAdded) {
  const float x = 1 + std::ldexp(1.f, -12), square = 1 + std::ldexp(1.f, -11);
  const __m128 a = unknown(x, x, x, x), b = unknown(square, square, square, square);
  EXPECT_EQ(floats(a * a - b), (FourFloats{0, 0, 0, 0}));
  EXPECT_EQ(floats(_mm_sub_ps(_mm_mul_ps(a, a), b)), (FourFloats{0, 0, 0, 0}));
}

}  // namespace
}  // namespace dspm
