// Against the C library's functions of doubles, rounded: floats from all of their range, what lies at its ends, and what
// C says of zeros, infinities and NaN. DSPM_SEEDS=2 or more tries sixteen times as many.
#include "dspm/base/math/rounded.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>

namespace dspm {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity(), kMost = std::numeric_limits<float>::max();
constexpr float kLeast = std::numeric_limits<float>::denorm_min();

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }
float of_bits(std::uint32_t b) { return std::bit_cast<float>(b); }

/// How often two functions differ, and by how many floats at most.
class Differences {
 public:
  void compare(float ours, double exact) {
    ++count_;
    const float expected = static_cast<float>(exact);
    if (std::isnan(ours) && std::isnan(expected)) return;
    if (bits(ours) == bits(expected)) return;
    ++differ_;
    const auto apart = static_cast<std::int64_t>(bits(ours)) - static_cast<std::int64_t>(bits(expected));
    if (std::abs(apart) > 1) ++far_;
  }
  void expect_few() const {
    EXPECT_EQ(far_, 0);
    EXPECT_LE(differ_, count_ / 1'000'000);
    EXPECT_GT(count_, 400'000);
  }

 private:
  std::int64_t count_ = 0, differ_ = 0, far_ = 0;
};

std::uint32_t step() { return std::getenv("DSPM_SEEDS") ? 611 : 9773; }

template <class Ours, class Exact>
void compare_all(Ours&& ours, Exact&& exact) {
  Differences differences;
  for (std::uint64_t b = 0; b < std::uint64_t{1} << 32; b += step()) {
    const float x = of_bits(static_cast<std::uint32_t>(b));
    differences.compare(ours(x), exact(double{x}));
  }
  for (const float x : {0.f, -0.f, 1.f, -1.f, 0.5f, -0.5f, kInf, -kInf, rounded::kNaN, kMost, -kMost, kLeast, -kLeast})
    differences.compare(ours(x), exact(double{x}));
  differences.expect_few();
}

TEST(Rounded, SineAndCosineOfAllFloats) {
  compare_all([](float x) { return rounded::sin(x); }, [](double x) { return std::sin(x); });
  compare_all([](float x) { return rounded::cos(x); }, [](double x) { return std::cos(x); });
  compare_all([](float x) { return rounded::tan(x); }, [](double x) { return std::tan(x); });
}

// Where sines and cosines are all but zero, few digits of the quarter turns are enough to spoil them.
TEST(Rounded, SineAndCosineNextToWholeQuartersOfATurn) {
  Differences differences;
  for (int quarter = 1; quarter < 20'000; ++quarter)
    for (int away = -16; away <= 16; ++away) {
      const float near = static_cast<float>(quarter * 1.57079632679489661923);
      const float x = of_bits(static_cast<std::uint32_t>(static_cast<int>(bits(near)) + away));
      differences.compare(rounded::sin(x), std::sin(double{x}));
      differences.compare(rounded::cos(-x), std::cos(-double{x}));
    }
  differences.expect_few();
}

TEST(Rounded, WholeNumbersBelowAllFloats) {
  for (std::uint64_t b = 0; b < std::uint64_t{1} << 32; b += step()) {
    const float x = of_bits(static_cast<std::uint32_t>(b));
    if (std::isnan(x)) continue;
    EXPECT_EQ(bits(rounded::floor(x)), bits(std::floor(x))) << x;
  }
  constexpr float kValues[] = {0.f,     -0.f,  0.3f,   -0.3f,          1.f,
                               -1.f,    7.99f, -7.99f, 0x1.fffffep22f, -0x1.fffffep22f,
                               0x1p31f, kMost, -kMost, kInf,           -kInf};
  constexpr auto kBelow = [&] {
    std::array<float, std::size(kValues)> below{};
    for (std::size_t i = 0; i < below.size(); ++i) below[i] = rounded::floor(kValues[i]);
    return below;
  }();
  for (std::size_t i = 0; i < kBelow.size(); ++i)
    EXPECT_EQ(bits(kBelow[i]), bits(std::floor(kValues[i]))) << kValues[i];
}

TEST(Rounded, InverseFunctionsOfAllFloats) {
  compare_all([](float x) { return rounded::asin(x); }, [](double x) { return std::asin(x); });
  compare_all([](float x) { return rounded::acos(x); }, [](double x) { return std::acos(x); });
  compare_all([](float x) { return rounded::atan(x); }, [](double x) { return std::atan(x); });
}

TEST(Rounded, ExponentialsAndLogarithmsOfAllFloats) {
  compare_all([](float x) { return rounded::exp(x); }, [](double x) { return std::exp(x); });
  compare_all([](float x) { return rounded::log(x); }, [](double x) { return std::log(x); });
  compare_all([](float x) { return rounded::log2(x); }, [](double x) { return std::log2(x); });
  compare_all([](float x) { return rounded::log1p(x); }, [](double x) { return std::log1p(x); });
  compare_all([](float x) { return rounded::cbrt(x); }, [](double x) { return std::cbrt(x); });
}

TEST(Rounded, ExponentialsOfTheirUsualArguments) {
  Differences differences;
  for (int i = -1'000'000; i < 900'000; ++i) {
    const float x = static_cast<float>(i) * 1e-4f;
    differences.compare(rounded::exp(x), std::exp(double{x}));
  }
  differences.expect_few();
}

TEST(Rounded, FunctionsOfTwoFloats) {
  Differences powers, angles, lengths;
  std::mt19937 random(1);
  // Of any size, or so that powers are neither 0 nor infinite.
  const auto any = [&] { return of_bits(static_cast<std::uint32_t>(random())); };
  const auto moderate = [&] {
    return std::ldexp(static_cast<float>(random() % 0x1000000 + 1), static_cast<int>(random() % 12) - 30);
  };
  for (int i = 0; i < 1'000'000; ++i) {
    const float x = i % 2 == 0 ? any() : moderate(), y = i % 4 < 2 ? any() : 60 * moderate();
    powers.compare(rounded::pow(x, y), std::pow(double{x}, double{y}));
    powers.compare(rounded::pow(x, std::trunc(y)), std::pow(double{x}, double{std::trunc(y)}));
    angles.compare(rounded::atan2(y, x), std::atan2(double{y}, double{x}));
    lengths.compare(rounded::hypot(x, y), std::sqrt(double{x} * x + double{y} * y));
  }
  powers.expect_few(), angles.expect_few(), lengths.expect_few();
}

TEST(Rounded, ZerosInfinitiesAndNanOfTwoFloatsAreAsInC) {
  const float values[] = {0.f,
                          -0.f,
                          1.f,
                          -1.f,
                          0.5f,
                          -0.5f,
                          2.f,
                          -2.f,
                          3.f,
                          -3.f,
                          2.5f,
                          kInf,
                          -kInf,
                          rounded::kNaN,
                          kMost,
                          kLeast,
                          0x1p23f,
                          0x1.000002p23f,
                          -0x1.000002p23f,
                          0x1.fffffep23f,
                          0x1p24f};
  const auto is_same = [](float a, float b) {  // to the last digit, which ours need not have right
    return std::isnan(a) ? std::isnan(b)
                         : bits(a) - bits(b) + 1 <= (std::isfinite(b) && b != 0 ? 2 : 1) && bits(a) + 1 >= bits(b);
  };
  for (const float x : values)
    for (const float y : values) {
      EXPECT_PRED2(is_same, rounded::pow(x, y), static_cast<float>(std::pow(double{x}, double{y})))
          << x << " to the " << y;
      EXPECT_PRED2(is_same, rounded::atan2(x, y), static_cast<float>(std::atan2(double{x}, double{y})))
          << x << " " << y;
    }
}

TEST(Rounded, SineAndCosineTogetherAreThoseApart) {
  for (const float x : {0.f, 0.3f, -2.f, 100.f, 3e7f, kInf}) {
    const rounded::SinCos both = rounded::sin_cos(x);
    EXPECT_EQ(bits(both.sin), bits(rounded::sin(x)));
    EXPECT_EQ(bits(both.cos), bits(rounded::cos(x)));
  }
}

/// What the compiler computes, which knows no C library.
TEST(Rounded, TheCompilerComputesTheSame) {
  volatile float x = 0.7f;
  constexpr float at_compile_time[] = {rounded::sin(0.7f),      rounded::cos(0.7f),  rounded::exp(0.7f),
                                       rounded::log(0.7f),      rounded::sqrt(0.7f), rounded::acos(0.7f),
                                       rounded::pow(0.7f, 0.7f)};
  const float now[] = {rounded::sin(x),  rounded::cos(x),  rounded::exp(x),   rounded::log(x),
                       rounded::sqrt(x), rounded::acos(x), rounded::pow(x, x)};
  for (int i = 0; i < 7; ++i) EXPECT_EQ(bits(at_compile_time[i]), bits(now[i])) << i;
}

}  // namespace
}  // namespace dspm
