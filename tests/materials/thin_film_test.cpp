// Thin films against Airy's formula with complex amplitudes of both polarisations, wavelength by wavelength.
#include "dspm/materials/thin_film.h"

#include <gtest/gtest.h>

#include <array>
#include <complex>

#include "dspm/base/colour/interference.h"
#include "dspm/base/colour/observer.h"
#include "dspm/materials/fresnel.h"

namespace dspm {
namespace {

double airy(double eta_film, double eta_base, double film_nm, double cos, double nm) {
  const auto cos_in = [&](double eta) { return std::sqrt(1 - (1 - cos * cos) / (eta * eta)); };
  const double inside = cos_in(eta_film), base = cos_in(eta_base);
  const auto once = std::polar(1., 4 * std::acos(-1.) * eta_film * film_nm * inside / nm);
  const auto reflectance = [&](double r12, double r23) {
    return std::norm((r12 + r23 * once) / (1. + r12 * r23 * once));
  };
  const auto across = [](double na, double ca, double nb, double cb) {
    return (na * ca - nb * cb) / (na * ca + nb * cb);
  };
  return 0.5 * (reflectance(across(1, cos, eta_film, inside), across(eta_film, inside, eta_base, base)) +
                reflectance(across(1, inside, eta_film, cos), across(eta_film, base, eta_base, inside)));
}

void expect_airy(float eta_film, float eta_base, float cos, float tolerance) {
  for (const float nm : {60.f, 150.f, 320.f, 500.f, 900.f}) {
    const Spectrum ours = ThinFilm(eta_film, nm, Palette::rgb()).over_dielectric(eta_base, cos);
    const auto exact = under_daylight([&](int wave) { return airy(eta_film, eta_base, nm, cos, wave); });
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(ours[c], exact[static_cast<std::size_t>(c)], tolerance)
          << eta_film << " on " << eta_base << ", " << nm << " nm, cosine " << cos << ", colour " << c;
  }
}

TEST(ThinFilm, IsAirysStraightOn) {
  expect_airy(1.33f, 1.5f, 1, 1e-3f);
  expect_airy(1.8f, 1.5f, 1, 3e-3f);
  expect_airy(2.2f, 3, 1, 0.02f);
}

// Off the normal, the polarisations are not told apart.
TEST(ThinFilm, IsCloseToAirysAtAnAngle) {
  expect_airy(1.33f, 1.5f, 0.7f, 3e-3f);
  expect_airy(1.8f, 1.5f, 0.7f, 0.02f);
}

TEST(ThinFilm, WithoutThicknessThereIsNone) {
  const ThinFilm none(1.8f, 0, Palette::rgb());
  for (const float cos : {1.f, 0.6f, 0.2f, 0.02f}) {
    const Spectrum gold = none.over_metal({0.9f, 0.6f, 0.1f}, cos), glass = none.over_dielectric(1.5f, cos);
    const float edge = std::pow(1 - cos, 5.f);
    EXPECT_NEAR(gold[0], 0.9f + 0.1f * edge, 1e-5f) << cos;
    EXPECT_NEAR(gold[2], 0.1f + 0.9f * edge, 1e-5f) << cos;
    EXPECT_NEAR(glass[1], fresnel_dielectric(cos, 1.5f), 1e-5f) << cos;
  }
}

TEST(ThinFilm, WhiteStaysWhite) {
  for (const float nm : {50.f, 300.f, 800.f})
    for (const float cos : {1.f, 0.5f, 0.1f})
      EXPECT_EQ(ThinFilm(1.5f, nm, Palette::rgb()).over_metal(Spectrum(1), cos), Spectrum(1));
}

TEST(ThinFilm, GainsNoMoreThanItSays) {
  for (const float film : {1.1f, 1.3f, 1.8f, 2.5f}) {
    const float most = ThinFilm::most_gain(film, 1.5f);
    for (float nm = 0; nm < 1500; nm += 17)
      for (const float cos : {1.f, 0.8f, 0.5f, 0.3f, 0.1f, 0.01f}) {
        const Spectrum mirrored = ThinFilm(film, nm, Palette::rgb()).over_dielectric(1.5f, cos);
        for (int c = 0; c < 3; ++c) {
          ASSERT_TRUE(mirrored[c] >= 0 && mirrored[c] <= 1);
          ASSERT_LE(mirrored[c], fresnel_dielectric(cos, 1.5f) + most + 1e-4f) << film << " " << nm << " " << cos;
        }
      }
  }
}

TEST(Interference, BeginsWhiteAndFades) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(interference(0)[c], 1, 1e-6f);
    for (float nm = 0; nm < 30'000; nm += 7) {
      const float colour = interference(nm)[c];
      EXPECT_LE(std::abs(colour), nm < 10'000 ? 1.6f : 0.1f) << nm;
    }
  }
}

}  // namespace
}  // namespace dspm
