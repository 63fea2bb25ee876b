// The phase function: samples against its density, its mean cosine, and its values.
#include "dspm/media/henyey_greenstein.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dspm/testing/chi2.h"

namespace dspm {
namespace henyey_greenstein_test {

constexpr float kMeanCosines[] = {-0.9f, -0.5f, 0, 5e-4f, 0.3f, 0.85f};

TEST(HenyeyGreenstein, SamplesItsDensity) {
  const Vec3 w = normalize({1, -2, 0.5f});
  for (const float g : kMeanCosines) {
    const HenyeyGreenstein phase(g);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    test::Chi2Settings settings;
    settings.axis = w, settings.tests = 6;
    double cosine = 0;
    const auto sample = [&]() -> std::optional<Vec3> {
      const Vec3 wi = phase.sample(w, {uniform(random), uniform(random)});
      cosine += static_cast<double>(dot(w, wi)) / settings.samples;
      return wi;
    };
    const auto result = test::SphereChi2(settings).run(sample, [&](const Vec3& wi) { return phase.pdf_w(w, wi); });
    EXPECT_TRUE(result.passed) << "g " << g << ", p " << result.p_value << "\n" << result.worst;
    EXPECT_NEAR(result.integral, 1, 1e-3) << g;
    EXPECT_NEAR(cosine, static_cast<double>(g), 0.006) << g;
  }
}

// (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^1.5), and both ends may change places.
TEST(HenyeyGreenstein, HasTheValuesOfTheFormula) {
  const HenyeyGreenstein phase(0.6f);
  const Vec3 w{0, 0, 1};
  for (const double cosine : {-1., -0.4, 0., 0.7, 1.}) {
    const Vec3 wi{static_cast<float>(std::sqrt(1 - cosine * cosine)), 0, static_cast<float>(cosine)};
    const double expected = (1 - 0.36) / (4 * 3.14159265358979 * std::pow(1 + 0.36 - 1.2 * cosine, 1.5));
    EXPECT_NEAR(static_cast<double>(phase.pdf_w(w, wi)) / expected, 1, 1e-5) << cosine;
    EXPECT_EQ(phase.pdf_w(w, wi), phase.pdf_w(-wi, -w)) << cosine;
  }
}

}  // namespace henyey_greenstein_test
}  // namespace dspm
