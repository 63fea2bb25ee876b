#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dspm/base/colour/sampled_colours.h"
#include "dspm/base/colour/spectral_curve.h"
#include "dspm/base/colour/spectrum_tables.h"
#include "dspm/base/math/vec.h"

namespace dspm {
namespace {

/// CIE chromaticity of linear Rec. 709 values: the inverse of the standard's matrix.
Vec2 chromaticity(const Rgb& c) {
  const float x = 0.412453f * c.r + 0.357580f * c.g + 0.180423f * c.b;
  const float y = 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b;
  const float z = 0.019334f * c.r + 0.119193f * c.g + 0.950227f * c.b;
  return {x / (x + y + z), y / (x + y + z)};
}

Vec2 chromaticity(std::string_view name) {
  return chromaticity(to_rgb(*named_spectrum(name), SpectrumRole::illuminant));
}

TEST(Spectrum, EveryNamedSpectrumIsWholeAndFinite) {
  const std::vector<std::string> names = spectrum_names();
  EXPECT_EQ(names.size(), 19u + 14u + 4u + 12u);
  for (const std::string& name : names) {
    const std::optional<SpectralCurve> spectrum = named_spectrum(name);
    ASSERT_TRUE(spectrum) << name;
    ASSERT_EQ(spectrum->nm.size(), spectrum->values.size());
    for (std::size_t i = 1; i < spectrum->nm.size(); ++i) EXPECT_GT(spectrum->nm[i], spectrum->nm[i - 1]) << name;
    for (const float value : spectrum->values) EXPECT_TRUE(std::isfinite(value) && value >= 0) << name;
    const bool absorbs_nothing = name == "metal-MgO-k" || name == "metal-TiO2-k";
    EXPECT_EQ(spectrum->values.back() == 0, absorbs_nothing) << name;
    for (const SpectrumRole role : {SpectrumRole::albedo, SpectrumRole::unbounded, SpectrumRole::illuminant}) {
      const Rgb rgb = to_rgb(*spectrum, role);
      EXPECT_TRUE(is_finite(rgb) && rgb.r >= 0 && rgb.g >= 0 && rgb.b >= 0) << name;
    }
  }
  EXPECT_FALSE(named_spectrum("metal-Unobtainium-eta"));
}

// The observer's three curves enclose equal areas: 106.86 in steps of 1 nm (CIE 15).
TEST(Spectrum, ObserverSeesEqualEnergyAsWhite) {
  const auto sum = [](const std::array<float, kObserverSamples>& table) {
    double total = 0;
    for (const float value : table) total += 5 * static_cast<double>(value);
    return total;
  };
  EXPECT_NEAR(sum(kObserverX), 106.865, 0.01);
  EXPECT_NEAR(sum(kObserverY), 106.857, 0.01);
  EXPECT_NEAR(sum(kObserverZ), 106.892, 0.01);
}

// Chromaticities as CIE 15 lists them, in the order of the lamps' numbers. Lines between samples of 5 nm cost the lamps
// some accuracy.
TEST(Spectrum, IlluminantsHaveTheirPublishedChromaticities) {
  EXPECT_NEAR(chromaticity("stdillum-A").x, 0.44757f, 2e-4f);
  EXPECT_NEAR(chromaticity("stdillum-A").y, 0.40745f, 2e-4f);
  EXPECT_NEAR(chromaticity("stdillum-D50").x, 0.34567f, 2e-4f);
  EXPECT_NEAR(chromaticity("stdillum-D50").y, 0.35850f, 2e-4f);
  EXPECT_NEAR(chromaticity("stdillum-D65").x, 0.31272f, 2e-4f);
  EXPECT_NEAR(chromaticity("stdillum-D65").y, 0.32903f, 2e-4f);
  EXPECT_NEAR(chromaticity("illum-acesD60").x, 0.32168f, 3e-4f);
  EXPECT_NEAR(chromaticity("illum-acesD60").y, 0.33767f, 3e-4f);
  constexpr Vec2 kLamps[12] = {{0.3131f, 0.3371f}, {0.3721f, 0.3751f}, {0.4091f, 0.3941f}, {0.4402f, 0.4031f},
                               {0.3138f, 0.3452f}, {0.3779f, 0.3882f}, {0.3129f, 0.3292f}, {0.3458f, 0.3586f},
                               {0.3741f, 0.3727f}, {0.3458f, 0.3588f}, {0.3805f, 0.3769f}, {0.4370f, 0.4042f}};
  for (int i = 0; i < 12; ++i) {
    const Vec2 c = chromaticity("stdillum-F" + std::to_string(i + 1));
    EXPECT_NEAR(c.x, kLamps[i].x, 6e-4f) << "F" << i + 1;
    EXPECT_NEAR(c.y, kLamps[i].y, 6e-4f) << "F" << i + 1;
  }
}

TEST(Spectrum, DaylightEqualsThePublishedTable) {
  const SpectralCurve d65 = *named_spectrum("stdillum-D65");  // CIE standard illuminant D65
  EXPECT_NEAR(d65.at(400), 82.7549f, 2e-3f);
  EXPECT_NEAR(d65.at(450), 117.008f, 2e-3f);
  EXPECT_NEAR(d65.at(465), 116.336f, 2e-3f);
  EXPECT_NEAR(d65.at(560), 100.f, 1e-4f);
  EXPECT_NEAR(d65.at(600), 90.0062f, 2e-3f);
  EXPECT_NEAR(d65.at(700), 71.6091f, 2e-3f);
  EXPECT_NEAR(d65.at(830), 60.3125f, 2e-3f);
}

// Index at the yellow d line and Abbe number (n_d - 1) / (n_F - n_C), from Schott's data sheets.
TEST(Spectrum, GlassesRefractAndDisperseAsMeasured) {
  struct Measured {
    const char* name;
    float index, abbe;
  };
  for (const Measured& glass : {Measured{"glass-BK7", 1.51680f, 64.17f},
                                {"glass-BAF10", 1.67003f, 47.11f},
                                {"glass-FK51A", 1.48656f, 84.47f},
                                {"glass-LASF9", 1.85025f, 32.17f},
                                {"glass-F5", 1.67271f, 32.25f},
                                {"glass-F10", 1.72828f, 28.53f},
                                {"glass-F11", 1.78472f, 25.68f}}) {
    const SpectralCurve n = *named_spectrum(glass.name);
    EXPECT_NEAR(n.at(587.5618f), glass.index, 2e-5f) << glass.name;
    EXPECT_NEAR((n.at(587.5618f) - 1) / (n.at(486.1327f) - n.at(656.2725f)), glass.abbe, 0.15f) << glass.name;
  }
}

TEST(Spectrum, IsLinearBetweenSamplesAndZeroOutside) {
  const SpectralCurve s{{400, 500, 700}, {1, 3, 5}};
  EXPECT_EQ(s.at(399), 0);
  EXPECT_EQ(s.at(400), 1);
  EXPECT_EQ(s.at(450), 2);
  EXPECT_EQ(s.at(500), 3);
  EXPECT_EQ(s.at(600), 4);
  EXPECT_EQ(s.at(700), 5);
  EXPECT_EQ(s.at(701), 0);
}

TEST(Spectrum, ConstantsStayWhatTheyAre) {
  for (const float value : {0.f, 0.18f, 1.f}) {
    const Rgb c = to_rgb({{300, 900}, {value, value}}, SpectrumRole::albedo);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(c[i], value, 1e-6f);
  }
  const Rgb held = to_rgb({{500, 600}, {1.5f, 1.5f}}, SpectrumRole::unbounded);  // holds beyond its samples
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(held[i], 1.5f, 1e-5f);
}

TEST(Spectrum, ColoursOfTheSameSamplesAreThoseOfEach) {
  const std::vector<float> nm = {340, 401.5f, 420, 500, 503, 590, 700, 1000};
  const SampledColours colours(nm);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> value(0, 2);
  for (int i = 0; i < 100; ++i) {
    std::vector<float> values(nm.size());
    for (float& v : values) v = i % 4 == 0 && value(random) > 0.5f ? 0 : value(random);  // some are outside Rec. 709
    const Rgb slow = to_rgb({nm, values}, SpectrumRole::unbounded), quick = colours.of(values);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(quick[c], slow[c], 2e-6f);
  }
}

TEST(Spectrum, ColoursAreTheRightWayRound) {
  const Rgb red = to_rgb({{600, 601, 830}, {0, .8f, .8f}}, SpectrumRole::albedo);
  EXPECT_GT(red.r, .5f);
  EXPECT_LT(red.g, .1f);
  EXPECT_EQ(red.b, 0);  // outside Rec. 709, clamped
  const Rgb blue = to_rgb({{360, 480, 481}, {.8f, .8f, 0}}, SpectrumRole::albedo);
  EXPECT_GT(blue.b, .5f);
  EXPECT_LT(blue.r, .2f);
}

TEST(Spectrum, EmissionHasLuminanceOneWhateverItsUnit) {
  const SpectralCurve lamp{{400, 500, 600, 700}, {1, 2, 3, 1}};
  SpectralCurve brighter = lamp;
  for (float& v : brighter.values) v *= 1000;
  EXPECT_NEAR(luminance(to_rgb(lamp, SpectrumRole::illuminant)), 1, 1e-5f);
  EXPECT_NEAR(to_rgb(lamp, SpectrumRole::illuminant).r, to_rgb(brighter, SpectrumRole::illuminant).r, 1e-5f);
  EXPECT_EQ(to_rgb({{400, 700}, {0, 0}}, SpectrumRole::illuminant), Rgb(0));
  EXPECT_EQ(to_rgb({}, SpectrumRole::illuminant), Rgb(0));
  const Rgb daylight = to_rgb(*named_spectrum("stdillum-D65"), SpectrumRole::illuminant);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(daylight[i], 1, 2e-3f);
}

// Chromaticities on the Planckian locus (CIE 1931), for which the second radiation constant is 0.014388 m K.
TEST(Spectrum, BlackBodiesLieOnThePlanckianLocus) {
  const auto at = [](float kelvin) { return chromaticity(to_rgb(blackbody(kelvin), SpectrumRole::illuminant)); };
  EXPECT_NEAR(at(3000).x, 0.4369f, 5e-4f);
  EXPECT_NEAR(at(3000).y, 0.4041f, 5e-4f);
  EXPECT_NEAR(at(5000).x, 0.3451f, 5e-4f);
  EXPECT_NEAR(at(5000).y, 0.3516f, 5e-4f);
  EXPECT_NEAR(at(10000).x, 0.2807f, 5e-4f);
  EXPECT_NEAR(at(10000).y, 0.2884f, 5e-4f);
}

TEST(Spectrum, ExtremeBlackBodiesStayFinite) {
  for (const float kelvin : {1e-3f, 1.f, 100.f, 500.f, 1e5f, 1e30f}) {
    const SpectralCurve body = blackbody(kelvin);
    for (const float value : body.values) EXPECT_TRUE(std::isfinite(value) && value >= 0 && value <= 1.0001f) << kelvin;
    EXPECT_TRUE(is_finite(to_rgb(body, SpectrumRole::illuminant))) << kelvin;
  }
}

/// Reflectance of a metal at normal incidence.
float fresnel(float eta, float k) { return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k); }

// Averaging eta and k first, as an RGB renderer must, against averaging the reflectance over wavelength.
TEST(Spectrum, MetalsKeepTheirColour) {
  for (const std::string metal : {"Ag", "Al", "Au", "Cu", "CuZn"}) {
    const SpectralCurve eta = *named_spectrum("metal-" + metal + "-eta"), k = *named_spectrum("metal-" + metal + "-k");
    SpectralCurve reflectance;
    for (float nm = 360; nm <= 830; ++nm) {
      reflectance.nm.push_back(nm);
      reflectance.values.push_back(fresnel(eta.at(nm), k.at(nm)));
    }
    const Rgb exact = to_rgb(reflectance, SpectrumRole::albedo);
    const Rgb e = to_rgb(eta, SpectrumRole::unbounded), a = to_rgb(k, SpectrumRole::unbounded);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(fresnel(e[i], a[i]), exact[i], metal == "Au" ? 0.05f : 0.02f) << metal << i;
  }
}

}  // namespace
}  // namespace dspm
