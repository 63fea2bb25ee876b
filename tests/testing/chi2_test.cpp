// The chi-square test itself: it must pass what is right and catch what is slightly wrong.
#include "dspm/testing/chi2.h"

#include <gtest/gtest.h>

#include "dspm/testing/scattering_cases.h"

namespace dspm::test {
namespace chi2_test {

// Upper tails that statistics tables print: 3.841 at 1 degree of freedom, 18.307 at 10, 124.342 at 100 (all 5%).
TEST(Chi2, TailsOfTheTable) {
  EXPECT_NEAR(chi2_tail(3.8415, 1), 0.05, 1e-5);
  EXPECT_NEAR(chi2_tail(18.3070, 10), 0.05, 1e-5);
  EXPECT_NEAR(chi2_tail(124.3421, 100), 0.05, 1e-5);
  EXPECT_NEAR(chi2_tail(69.3349, 99), 0.99, 1e-2);
  EXPECT_EQ(chi2_tail(0, 5), 1);
}

/// The p-values of cosine-distributed directions, 1% of them absorbed, against a density wrong by `error` at the pole.
double p_value(float error, const Vec3& axis) {
  const PathRandom random(7, Stream::setup, 1, 0);
  int n = 0;
  Chi2Settings settings;
  settings.axis = axis;
  const auto sample = [&]() -> std::optional<Vec3> {
    const Vec3 u = three_numbers(random, n++);
    if (u.z < 0.01f) return std::nullopt;
    return direction(std::sqrt(u.x), 2 * kPi * u.y);
  };
  const auto pdf = [&](const Vec3& w) { return 0.99f * std::max(0.f, w.z) / kPi * (1 + error * (w.z - 2.f / 3)); };
  const Chi2Result result = SphereChi2(settings).run(sample, pdf);
  EXPECT_NEAR(result.integral, 0.99, 1e-4);
  EXPECT_EQ(result.passed, result.p_value >= 0.01) << result.worst;
  return result.p_value;
}

TEST(Chi2, TellsRightFromWrong) {
  for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{0.6f, 0, 0.8f}}) {
    EXPECT_GT(p_value(0, axis), 0.05);
    EXPECT_LT(p_value(0.4f, axis), 1e-4);
  }
}

TEST(Chi2, SamplesWhereNoneMayBeFail) {
  const PathRandom random(7, Stream::setup, 2, 0);
  int n = 0;
  const auto sample = [&]() -> std::optional<Vec3> {
    const Vec3 u = three_numbers(random, n++);
    return direction(u.z < 0.002f ? -u.x : u.x, 2 * kPi * u.y);
  };
  EXPECT_FALSE(SphereChi2({}).run(sample, [](const Vec3& w) { return w.z > 0 ? 0.5f / kPi : 0.f; }).passed);
}

}  // namespace chi2_test
}  // namespace dspm::test
