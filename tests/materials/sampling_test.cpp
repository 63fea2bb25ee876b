// Samples follow the density that pdf_w claims: chi-square at a level of 1% for the whole suite, seeds fixed.
#include <gtest/gtest.h>

#include "dspm/testing/scattering.h"
#include "tests/materials/materials.h"
#include "tests/support/seeds.h"

namespace dspm::test {
namespace {

TEST(Sampling, FollowsTheDensity) {
  std::uint64_t seed = 1;
  const std::vector<Named> all = all_materials();
  for (const Named& each : all) {
    const Verdict verdict =
        samples_follow_density(*each.material, 0.01 / static_cast<double>(all.size()), seed, seeds(6'000));
    EXPECT_TRUE(verdict.passed) << each.name << ": " << verdict.message;
    seed += 100;
  }
}

}  // namespace
}  // namespace dspm::test
