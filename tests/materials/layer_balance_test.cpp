// Layers over facets: all that a layer leaves to white facets passes it again.
#include "dspm/materials/principled/layer_balance.h"

#include <gtest/gtest.h>

#include "dspm/materials/facet_albedo.h"

namespace dspm {
namespace {

constexpr float kEta = 1.5f;

const LayerBalance& coats() {
  static const LayerBalance balance(
      AlbedoTable([](float cos, float alpha) { return reflected_by_boundary(cos, alpha, kEta); }));
  return balance;
}
float left(float share, float cos) { return 1 - share * fresnel_dielectric(cos, kEta); }
float passed(float share, float cos, float alpha) {
  return left(share, cos) / std::sqrt(coats().mean_left(share, cos, alpha, 0));
}

TEST(LayerBalance, OfMirrorsIsWhatTheLayerLeaves) {
  for (const float cos : {1.f, 0.5f, 0.2f, 0.05f})
    EXPECT_NEAR(coats().mean_left(1, cos, 0, 0), left(1, cos), 5e-3) << cos;
}

// a(o) times the integral of f(o, i) a(i) cos(i), of white GGX facets and the lobe that makes up for them.
TEST(LayerBalance, LosesNothing) {
  const AlbedoTable metal([](float cos, float a) { return reflected_by_facets(cos, a, [](float) { return 1.f; }); });
  for (const float alpha : {0.05f, 0.2f, 0.5f, 1.f})
    for (const float share : {1.f, 0.4f}) {
      const auto a = [&](float cos) { return static_cast<double>(passed(share, cos, alpha)); };
      constexpr int kSteps = 200;
      double of_lost = 0, lost = 0;
      for (int i = 0; i < kSteps; ++i) {
        const float cos = (static_cast<float>(i) + 0.5f) / kSteps;
        const auto here = static_cast<double>((1 - metal.of(cos, alpha)) * cos);
        lost += here, of_lost += here * a(cos);
      }
      const Ggx facets({alpha, alpha});
      for (const float cos : {1.f, 0.7f, 0.4f, 0.2f, 0.1f}) {
        const Vec3 o = direction_of_cosine(cos);
        double sum = static_cast<double>(1 - metal.of(cos, alpha)) * of_lost / lost;
        for_facets(facets, o, {48, 96, 0.5f}, [&](const Vec3& m, float weight) {
          const Vec3 i = reflect(o, m);
          if (i.z > 0) sum += static_cast<double>(weight * facets.visible_after(o, i)) * a(i.z);
        });
        EXPECT_NEAR(a(cos) * sum, static_cast<double>(left(share, cos)), 6e-3) << alpha << " " << share << " " << cos;
      }
    }
}

}  // namespace
}  // namespace dspm
