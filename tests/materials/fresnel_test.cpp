// Fresnel's equations against values known by heart, and against complex arithmetic in double precision.
#include "dspm/materials/fresnel.h"

#include <gtest/gtest.h>

#include <complex>

namespace dspm {
namespace {

/// Reflectance for a complex index, straight from the textbook: r_s and r_p with cos_t = sqrt(1 - sin^2 / n^2).
double textbook(double cos_i, std::complex<double> n) {
  const std::complex<double> cos_t = std::sqrt(1.0 - (1 - cos_i * cos_i) / (n * n));
  const auto r_s = (cos_i - n * cos_t) / (cos_i + n * cos_t), r_p = (n * cos_i - cos_t) / (n * cos_i + cos_t);
  return 0.5 * (std::norm(r_s) + std::norm(r_p));
}

TEST(Fresnel, NormalIncidence) {
  for (const float n : {1.f / 1.5f, 1.1f, 1.33f, 1.5f, 2.4f})
    EXPECT_NEAR(fresnel_dielectric(1, n), std::pow((n - 1) / (n + 1), 2.f), 1e-6f) << n;
  EXPECT_NEAR(fresnel_conductor(1, 0.2f, 3.9f), textbook(1, {0.2, 3.9}), 1e-6);
}

// At Brewster's angle, tan = n, nothing polarised along the plane of incidence is reflected; what is left is half of
// ((n^2 - 1) / (n^2 + 1))^2.
TEST(Fresnel, BrewstersAngle) {
  for (const float n : {1.33f, 1.5f, 2.4f}) {
    const float n2 = n * n, r_s = (n2 - 1) / (n2 + 1);
    EXPECT_NEAR(fresnel_dielectric(1 / std::sqrt(1 + n2), n), 0.5f * r_s * r_s, 1e-6f) << n;
  }
}

TEST(Fresnel, TotalReflectionBeyondTheCriticalAngle) {
  const float eta = 1 / 1.5f, critical = std::sqrt(1 - eta * eta);
  EXPECT_LT(fresnel_dielectric(critical + 1e-3f, eta), 1);
  EXPECT_EQ(fresnel_dielectric(critical - 1e-4f, eta), 1);
  EXPECT_EQ(fresnel_dielectric(0, eta), 1);
  EXPECT_EQ(fresnel_dielectric(0, 1.5f), 1);
  const Vec3 shallow{std::sqrt(1 - 0.01f), 0, 0.1f};
  EXPECT_FALSE(refract(shallow, {0, 0, 1}, eta));
  EXPECT_TRUE(refract(shallow, {0, 0, 1}, 1.5f));
}

TEST(Fresnel, IsNeverNegative) {
  for (int i = 1; i < 100'000; ++i) ASSERT_GE(fresnel_conductor(static_cast<float>(i) * 1e-5f, 1, 0), 0) << i;
}

TEST(Fresnel, AgreesWithComplexArithmetic) {
  for (int i = 0; i <= 100; ++i) {
    const float c = static_cast<float>(i) / 100;
    for (const float n : {0.7f, 1.3f, 1.5f, 2.4f})
      EXPECT_NEAR(fresnel_dielectric(c, n), textbook(static_cast<double>(c), static_cast<double>(n)), 2e-6)
          << c << " " << n;
    for (const auto& [eta, k] : {std::pair{0.2f, 3.9f}, {1.5f, 0.f}, {2.9f, 3.1f}, {1.f, 200.f}, {0.05f, 5.f}})
      EXPECT_NEAR(fresnel_conductor(c, eta, k),
                  textbook(static_cast<double>(c), {static_cast<double>(eta), static_cast<double>(k)}), 1e-5)
          << c << " " << eta << " " << k;
  }
}

TEST(Fresnel, RefractionObeysSnell) {
  for (const float eta : {0.7f, 1.5f})
    for (const float c : {1.f, 0.9f, 0.8f}) {
      const float s = std::sqrt(1 - c * c);
      const auto wi = refract({s * 0.6f, s * 0.8f, c}, {0, 0, 1}, eta);
      ASSERT_TRUE(wi);
      EXPECT_NEAR(length(*wi), 1, 1e-6f);
      EXPECT_NEAR(wi->x, -s * 0.6f / eta, 1e-6f);
      EXPECT_NEAR(wi->y, -s * 0.8f / eta, 1e-6f);
      EXPECT_LT(wi->z, 0);
    }
}

// 9.18% of diffuse light off glass of index 1.5, 59.6% of what comes from inside: from the closed form of Walsh (1926).
TEST(Fresnel, MeanOverDiffuseLight) {
  const double n = 1.5, n2 = n * n, n4 = n2 * n2;
  const double walsh = 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
                       n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
                       2 * n2 * n * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
                       8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
  EXPECT_NEAR(mean_fresnel_outside(1.5f), walsh, 1e-5);
  // From inside what passes is the same flux over n^2, because reciprocity holds: total reflection and all.
  double sum = 0;
  for (int i = 0; i < 20000; ++i) {
    const float c = (static_cast<float>(i) + 0.5f) / 20000;
    sum += static_cast<double>(fresnel_dielectric(c, 1 / 1.5f) * c) * 2 / 20000;
  }
  EXPECT_NEAR(1 - (1 - walsh) / n2, sum, 1e-4);
}

}  // namespace
}  // namespace dspm
