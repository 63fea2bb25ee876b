// Colour spaces against published matrices and white points.
#include "dspm/base/colour/colour_space.h"

#include <gtest/gtest.h>

namespace dspm {
namespace {

void expect_near(const ColourMatrix& a, const ColourMatrix& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(a[i][j], b[i][j], tolerance) << i << ' ' << j;
}

ColourMatrix to_rec709_matrix(ColourSpace space, bool adapts) {
  const Chromaticities &from = chromaticities(space), &to = chromaticities(ColourSpace::srgb);
  const ColourMatrix in = xyz_from_rgb(from), out = rgb_from_xyz(to);
  return adapts ? out * adaptation(from.white, to.white) * in : out * in;
}

TEST(ColourSpace, MatricesAreThePublishedOnes) {
  // IEC 61966-2-1.
  expect_near(xyz_from_rgb(chromaticities(ColourSpace::srgb)),
              {{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}}, 1e-4);
  // ITU-R BT.2087-0, the inverse of its table.
  expect_near(to_rec709_matrix(ColourSpace::rec2020, false),
              {{{1.6605, -0.5876, -0.0728}, {-0.1246, 1.1329, -0.0083}, {-0.0182, -0.1006, 1.1187}}}, 1e-4);
  // SMPTE ST 2065-1, annex: AP0 to XYZ.
  expect_near(xyz_from_rgb(chromaticities(ColourSpace::aces2065_1)),
              {{{0.95255, 0, 0.00009}, {0.34397, 0.72817, -0.07213}, {0, 0, 1.00883}}}, 2e-5);
  // Display P3 to sRGB, as CSS Color 4 has it.
  expect_near(to_rec709_matrix(ColourSpace::dci_p3, false),
              {{{1.22494, -0.22494, 0}, {-0.04206, 1.04206, 0}, {-0.01964, -0.07864, 1.09827}}}, 1e-4);
  // The Academy's AP0 to Rec. 709 has its CAT02 adaptation; Bradford's differs from it by less than a hundredth.
  expect_near(to_rec709_matrix(ColourSpace::aces2065_1, true),
              {{{2.5217, -1.1341, -0.3876}, {-0.2765, 1.3727, -0.0962}, {-0.0154, -0.1530, 1.1684}}}, 0.01);
}

TEST(ColourSpace, BradfordsAdaptationIsTheIccs) {
  // D65 to D50, ICC.1:2010, annex E; D50 is (0.9642, 1, 0.8249).
  const double sum = 0.9642 + 1 + 0.8249;
  expect_near(adaptation({0.3127, 0.3290}, {0.9642 / sum, 1 / sum}),
              {{{1.0479, 0.0229, -0.0502}, {0.0296, 0.9904, -0.0171}, {-0.0092, 0.0151, 0.7519}}}, 3e-4);
}

TEST(ColourSpace, WordsArePbrts) {
  for (const std::string& word : colour_space_words()) EXPECT_EQ(word_of(*colour_space(word)), word);
  EXPECT_EQ(colour_space("aces2065-1"), ColourSpace::aces2065_1);
  EXPECT_FALSE(colour_space("sRGB"));
}

// CIE 15: D50 (0.3457, 0.3585), D65 (0.3127, 0.3290), D75 (0.2990, 0.3149); illuminant A is a black body of 2856 K.
TEST(ColourSpace, WhitesOfDaylight) {
  const auto expect_white = [](double kelvin, double x, double y, double tolerance) {
    const Chromaticity white = white_of(kelvin);
    EXPECT_NEAR(white.x, x, tolerance) << kelvin;
    EXPECT_NEAR(white.y, y, tolerance) << kelvin;
  };
  expect_white(5000, 0.3457, 0.3585, 2e-4);
  expect_white(6500, 0.3127, 0.3290, 2e-4);
  expect_white(7500, 0.2990, 0.3149, 2e-4);
  expect_white(2856 * 1.438 / 1.4388, 0.4476, 0.4074, 2e-4);
}

TEST(ColourSpace, AnAlbedoOf1StaysAndLightKeepsItsColour) {
  for (const std::string& word : colour_space_words()) {
    const ColourSpace space = *colour_space(word);
    for (const SpectrumRole role : {SpectrumRole::albedo, SpectrumRole::unbounded}) {
      const Rgb white = to_rec709(Rgb(1), space, role);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1, 1e-6f) << word;
    }
    EXPECT_NEAR(luminance(to_rec709(Rgb(1), space, SpectrumRole::illuminant)), 1, 1e-3f) << word;
  }
  const Rgb d60 = to_rec709(Rgb(1), ColourSpace::aces2065_1, SpectrumRole::illuminant);
  EXPECT_GT(d60.r, 1.02f);
  EXPECT_LT(d60.b, 0.92f);
}

TEST(ColourSpace, WhatRec709CannotHoldIsClamped) {
  const Rgb green = to_rec709({0, 1, 0}, ColourSpace::rec2020, SpectrumRole::albedo);
  EXPECT_EQ(green, Rgb(0, 1, 0));
  const Rgb light = to_rec709({0, 2, 0}, ColourSpace::rec2020, SpectrumRole::illuminant);
  EXPECT_EQ(light.r, 0);
  EXPECT_NEAR(light.g, 2 * 1.1329f, 1e-3f);
  EXPECT_EQ(light.b, 0);
  EXPECT_EQ(to_rec709({.1f, .2f, .3f}, ColourSpace::srgb, SpectrumRole::albedo), Rgb(.1f, .2f, .3f));
}

}  // namespace
}  // namespace dspm
