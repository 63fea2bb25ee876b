// Palettes of spectral iterations: whatever an author says comes back as its colour, on average over few iterations.
#include "dspm/base/colour/palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "dspm/base/colour/smooth_spectra.h"
#include "dspm/base/colour/wavelength.h"

namespace dspm {
namespace {

std::vector<Rgb> some_colours() {
  std::vector<Rgb> colours{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {0.5f, 0.5f, 0.5f}};
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(0, 1);
  for (int i = 0; i < 60; ++i) colours.emplace_back(unit(random), unit(random), unit(random));
  return colours;
}

/// The mean over iterations of what the palette sees of carry(palette).
template <class Carry>
Rgb mean_seen(int iterations, Carry&& carry) {
  Rgb sum;
  for (int i = 0; i < iterations; ++i) {
    const auto palette = Palette::of_iteration(3, static_cast<std::uint64_t>(i));
    sum += palette->seen(carry(*palette));
  }
  return sum / static_cast<float>(iterations);
}

void expect_near(const Rgb& found, const Rgb& expected, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << c;
}

template <class Value>
Rgb colour_of(Value&& value) {
  Rgb sum;
  for (int nm = kFirstNm; nm <= kLastNm; ++nm)
    for (std::size_t c = 0; c < 3; ++c)
      sum[static_cast<int>(c)] += static_cast<float>(part_of_white(nm)[c] * static_cast<double>(value(nm)));
  return sum;
}

TEST(SmoothSpectra, HaveTheirColours) {
  for (int r = 0; r < SmoothSpectra::kSide; r += 2)
    for (int g = 0; g < SmoothSpectra::kSide; g += 2)
      for (int b = 0; b < SmoothSpectra::kSide; b += 2) {
        const SmoothSpectrum& spectrum = SmoothSpectra::all().at(r, g, b);
        const Rgb expected = Rgb(static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)) / 16;
        expect_near(colour_of([&](int nm) { return spectrum.at(nm); }), expected, 1.5e-3f);
      }
}

TEST(Palette, OfRgbChangesNothing) {
  const Rgb c(0.1f, 3, 0);
  EXPECT_EQ(Palette::rgb().carried(c), Spectrum(0.1f, 3, 0));
  EXPECT_EQ(Palette::rgb().light(c), Spectrum(0.1f, 3, 0));
  EXPECT_EQ(Palette::rgb().per_length(c), Spectrum(0.1f, 3, 0));
  EXPECT_EQ(Palette::rgb().seen(Spectrum(0.1f, 3, 0)), c);
}

TEST(Palette, ColoursComeBack) {
  for (const Rgb& c : some_colours()) {
    expect_near(mean_seen(16, [&](const Palette& p) { return p.carried(c); }), c, 0.012f);
    expect_near(mean_seen(64, [&](const Palette& p) { return p.carried(c); }), c, 0.004f);
    expect_near(mean_seen(64, [&](const Palette& p) { return p.light(c * 7); }), c * 7, 0.03f);
  }
}

TEST(Palette, ReflectancesReflectNoMoreThanAll) {
  for (std::uint64_t i = 0; i < 40; ++i)
    for (const Rgb& c : some_colours()) {
      const Spectrum carried = Palette::of_iteration(1, i)->carried(c);
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(carried[k], 0);
        EXPECT_LE(carried[k], 1.00001f);
      }
    }
}

// Blends have no negative shares.
TEST(Palette, BlendsLieBetweenTheCornersOfTheirCells) {
  constexpr int kCells = SmoothSpectra::kSide - 1;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto palette = Palette::of_iteration(6, i);
    for (const Rgb& c : some_colours())
      for (int k = 0; k < 3; ++k) {
        float least = 1, most = 0;
        for (int corner = 0; corner < 8; ++corner) {
          std::array<int, 3> place{};
          for (int axis = 0; axis < 3; ++axis)
            place[static_cast<std::size_t>(axis)] =
                std::min(static_cast<int>(c[axis] * kCells), kCells - 1) + (corner >> axis & 1);
          const float at = SmoothSpectra::all().at(place[0], place[1], place[2]).at(palette->nm(k));
          least = std::min(least, at), most = std::max(most, at);
        }
        EXPECT_GE(palette->carried(c)[k], least - 1e-5f);
        EXPECT_LE(palette->carried(c)[k], most + 1e-5f);
      }
  }
}

TEST(Palette, LightIsAReflectanceOfHalfTheStrengthTwice) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto palette = Palette::of_iteration(6, i);
    for (const Rgb& c : some_colours()) {
      const float twice = 2 * max_component(c);
      const Spectrum light = palette->light(7 * c), expected = 7 * twice * palette->carried(c / twice);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(light[k], expected[k], 1e-4f);
    }
  }
}

TEST(Palette, GreyIsGreyAtEachWavelength) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto palette = Palette::of_iteration(2, i);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(palette->carried(Rgb(0.3f))[k], 0.3f, 1e-5f);
      EXPECT_NEAR(palette->light(Rgb(40))[k], 40, 1e-3f);
      EXPECT_NEAR(palette->per_length(Rgb(2))[k], 2, 1e-5f);
    }
    EXPECT_GE(palette->luminance(Spectrum(1, 0, 0)), 0);
    EXPECT_GE(palette->luminance(Spectrum(0, 1, 0)), 0);
  }
}

TEST(Palette, BoundsOfMattersAreBounds) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto palette = Palette::of_iteration(2, i);
    const auto colours = some_colours();
    for (std::size_t n = 1; n < colours.size(); ++n) {
      const Rgb &a = colours[n - 1], &b = colours[n];
      const Rgb most(std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b));
      for (int k = 0; k < 3; ++k)
        EXPECT_GE(palette->per_length(most)[k] * 1.00001f,
                  std::max(palette->per_length(a)[k], palette->per_length(b)[k]));
    }
  }
}

TEST(Palette, TakesSpectraAsTheyAre) {
  const SpectralCurve band{{500, 560, 561, 620}, {0.2f, 0.9f, 0.1f, 0.4f}};
  const Colour albedo = Colour::of(band, SpectrumRole::albedo);
  const Colour lamp = Colour::of(*named_spectrum("stdillum-F7"), SpectrumRole::illuminant);
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto palette = Palette::of_iteration(5, i);
    const Spectrum carried = palette->carried(albedo);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(carried[k], band.at(static_cast<float>(palette->nm(k))));
  }
  expect_near(mean_seen(256, [&](const Palette& p) { return p.at_its(*lamp.spectrum); }), lamp.rgb, 0.02f);
  EXPECT_NEAR(luminance(colour_of([&](int nm) { return lamp.spectrum->at(nm); })), 1, 2e-3f);
}

TEST(Palette, InterferenceIsACosineAtEachWavelength) {
  const auto palette = Palette::of_iteration(5, 7);
  const Spectrum waves = palette->interference(1234.5f);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(waves[k], std::cos(2 * std::acos(-1.) * 1234.5 / palette->nm(k)), 1e-5);
}

}  // namespace
}  // namespace dspm
