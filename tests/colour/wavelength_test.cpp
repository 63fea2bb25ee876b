// The wavelengths of iterations: white on average, whichever iterations are taken, and the colours of the rainbow.
#include "dspm/base/colour/wavelength.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dspm {
namespace {

TEST(Hue, IsWhiteOnAverageAndNeverNegative) {
  double all = 0;
  std::array<double, 3> white{};
  for (int nm = kFirstNm; nm <= kLastNm; ++nm) {
    const double p = wavelength_probability(nm);
    all += p;
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(hue(nm)[c], 0) << nm;
      white[static_cast<std::size_t>(c)] += p * double{hue(nm)[c]};
    }
  }
  EXPECT_NEAR(all, 1, 1e-9);
  for (const double c : white) EXPECT_NEAR(c, 1, 1e-6);
}

TEST(Hue, IsThatOfTheSpectrum) {
  EXPECT_GT(hue(450)[2], 10 * hue(450)[1]);
  EXPECT_GT(hue(530)[1], 10 * std::max(hue(530)[0], hue(530)[2]));
  EXPECT_GT(hue(640)[0], 10 * std::max(hue(640)[1], hue(640)[2]));
  EXPECT_GT(std::min(hue(575)[0], hue(575)[1]), 10 * hue(575)[2]);  // yellow
}

/// The largest difference from white, of any colour, of the mean hue of `count` iterations from `first` on, `step` apart.
float difference_from_white(std::uint64_t seed, int first, int count, int step = 1) {
  Spectrum sum;
  for (int i = 0; i < count; ++i) sum += hue(wavelength_of(seed, static_cast<std::uint64_t>(first + i * step)));
  const Spectrum mean = sum / static_cast<float>(count);
  return std::max({std::abs(mean[0] - 1), std::abs(mean[1] - 1), std::abs(mean[2] - 1)});
}

// A colour's share of n independent wavelengths has a standard deviation of about 1.4 / sqrt(n): 0.35 of 16, 0.09 of 256.
TEST(Wavelengths, AreSpreadEvenlyOverAnyIterations) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    EXPECT_LT(difference_from_white(seed, 0, 8), 0.12f) << seed;
    EXPECT_LT(difference_from_white(seed, 0, 16), 0.03f) << seed;
    EXPECT_LT(difference_from_white(seed, 0, 64), 0.008f) << seed;
    for (const int first : {1, 100, 12345}) {
      EXPECT_LT(difference_from_white(seed, first, 64), 0.12f) << seed << " " << first;
      EXPECT_LT(difference_from_white(seed, first, 256), 0.02f) << seed << " " << first;
    }
    // Those of one of several machines.
    for (const int machines : {2, 3, 4, 7})
      EXPECT_LT(difference_from_white(seed, 0, 256, machines), 0.1f) << seed << " " << machines;
  }
}

TEST(Wavelengths, FollowTheirProbability) {
  double sum = 0;
  for (int nm = kFirstNm; nm < kLastNm; ++nm) {
    const double p = wavelength_probability(nm);
    if (p > 1e-6) {
      EXPECT_EQ(wavelength_at(sum + p / 2), nm);
    }
    sum += p;
  }
}

}  // namespace
}  // namespace dspm
