// Tables of facets rougher along one tangent than along the other, against a slow integral.
#include "dspm/materials/brushed_albedo.h"

#include <gtest/gtest.h>

#include "dspm/materials/brushed_tables.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/metal_tables.h"
#include "dspm/testing/scattering_cases.h"

namespace dspm {
namespace {

/// The share of light from o that leaves white facets, over all of them.
double integral(const Ggx& facets, const Vec3& o) {
  constexpr int kAround = 48, kDown = 48;
  double sum = 0;
  for (int i = 0; i < kAround; ++i)
    for (int j = 0; j < kDown; ++j) {
      const Vec3 m =
          facets.sample_visible(o, (static_cast<float>(i) + 0.5f) / kAround, (static_cast<float>(j) + 0.5f) / kDown);
      const Vec3 to = reflect(o, m);
      if (to.z > 0) sum += static_cast<double>(facets.visible_after(o, to));
    }
  return sum / (kAround * kDown);
}

TEST(BrushedAlbedo, IsThatOfFacets) {
  for (const Vec2 alpha : {Vec2{0.1f, 0.1f}, Vec2{0.3f, 0.2f}, Vec2{0.5f, 0.1f}, Vec2{0.8f, 0.08f}, Vec2{1, 0.4f}}) {
    const Ggx facets(alpha);
    for (const float cos : {1.f, 0.8f, 0.5f, 0.2f, 0.07f})
      for (const float phi : {0.f, 0.3f, 0.8f, 1.2f, 1.57f, 2.5f}) {
        const Vec3 o = test::direction(cos, phi);
        EXPECT_NEAR(brushed_metal().of(cos, BrushedAlbedo::turn(o, alpha), alpha), integral(facets, o), 0.02)
            << alpha.x << " " << alpha.y << " " << cos << " " << phi;
      }
  }
}

TEST(BrushedAlbedo, MeanIsThatOfDiffuseLight) {
  for (const Vec2 alpha : {Vec2{0.2f, 0.2f}, Vec2{0.5f, 0.1f}, Vec2{1, 0.3f}}) {
    constexpr int kSteps = 12;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const float cos = std::sqrt((static_cast<float>(i) + 0.5f) / kSteps);
        sum += integral(Ggx(alpha), test::direction(cos, (static_cast<float>(j) + 0.5f) / kSteps * kPi / 2));
      }
    EXPECT_NEAR(brushed_metal().mean(alpha), sum / (kSteps * kSteps), 5e-3) << alpha.x << " " << alpha.y;
  }
}

// Indices of refraction between those that are integrated.
TEST(BrushedAlbedo, IsMixedBetweenIndices) {
  const Vec2 alpha{0.5f, 0.2f};
  const auto of = [&](float eta) { return static_cast<double>(brushed_dielectric(eta)->mean(alpha)); };
  EXPECT_NEAR(of(1.52f), 0.6 * of(1.5f) + 0.4 * of(1.55f), 1e-5);
  EXPECT_EQ(brushed_dielectric(1.52f), brushed_dielectric(1.52f));
}

}  // namespace
}  // namespace dspm
