// Tables for indices of refraction between those that are integrated.
#include "dspm/materials/boundary_tables.h"

#include <gtest/gtest.h>

#include <chrono>

#include "dspm/materials/facet_albedo.h"

namespace dspm {
namespace {

constexpr float kIndices[] = {1.01f, 1.13f, 1.333f, 1.517f, 1.7731f, 2.417f};
constexpr float kAlphas[] = {0.04f, 0.25f, 1.f};

/// As the tables integrate it, of diffuse light.
double mean_reflected(float alpha, float eta) {
  return static_cast<double>(
      AlbedoTable([&](float cos, float a) { return reflected_by_boundary(cos, a, eta); }).mean(alpha));
}

TEST(BoundaryTables, AreThoseOfTheIndex) {
  for (const float eta : kIndices)
    for (const float alpha : kAlphas) {
      const auto tables = boundary_tables(eta);
      const std::string where = "eta " + std::to_string(eta) + ", alpha " + std::to_string(alpha);
      EXPECT_NEAR(tables->outside.reflected.mean(alpha), mean_reflected(alpha, eta), 1e-3) << where;
      EXPECT_NEAR(tables->inside.reflected.mean(alpha), mean_reflected(alpha, 1 / eta), 2e-3) << where;
    }
}

TEST(BoundaryTables, GiveBackTheSameForOneIndex) { EXPECT_EQ(boundary_tables(1.37f), boundary_tables(1.37f)); }

TEST(BoundaryTables, OfManyIndicesAreFewIntegrals) {
  const auto seconds_for = [](auto&& make) {
    const auto begin = std::chrono::steady_clock::now();
    make();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const double one = seconds_for([] { boundary_tables(3.f); });
  const double hundred = seconds_for([] {
    for (int i = 1; i <= 100; ++i) boundary_tables(3 + 0.05f * static_cast<float>(i) / 101);
  });
  EXPECT_LT(hundred, 25 * one);
}

}  // namespace
}  // namespace dspm
