// Samples follow the density that pdf_w claims: chi-square at a level of 1% for the whole suite, seeds fixed. Every
// material, from straight on to grazing, from outside and inside, with bent shading normals, all lobes and each alone.
#include <gtest/gtest.h>

#include "materials/fresnel.h"
#include "tests/materials/materials.h"
#include "tests/support/chi2.h"

namespace dspm::test {
namespace {

constexpr int kTests = 1100;  // at least as many as there are below

/// Where the density peaks: near the mirror direction, or what is refracted.
Vec3 peak(const Vec3& wo, const Vec3& ns, LobeSet lobes, float eta) {
  const Vec3 n = dot(wo, ns) > 0 ? ns : -ns;
  const std::optional<Vec3> through = lobes == 2 ? refract(wo, n, dot(wo, ns) > 0 ? eta : 1 / eta) : std::nullopt;
  return normalize(through.value_or(reflect(wo, n)));
}

void expect_agreement(const std::string& name, const Bsdf& bsdf, const SurfacePoint& point, const Vec3& wo,
                      LobeSet lobes, std::uint64_t seed) {
  const PathRandom random(seed, Stream::setup, 0, 0);
  int n = 0;
  Chi2Settings settings;
  settings.axis = peak(wo, point.ns, lobes, 1.5f);
  settings.samples = 40'000;
  settings.tests = kTests;
  const auto sample = [&]() -> std::optional<Vec3> {
    const auto drawn = bsdf.sample(wo, three_numbers(random, n++), Transport::radiance, lobes);
    if (!drawn || drawn->specular) return std::nullopt;
    return drawn->wi;
  };
  const auto pdf = [&](const Vec3& wi) { return bsdf.pdf_w(wo, wi, Transport::radiance, lobes); };
  const Chi2Result result = SphereChi2(settings).run(sample, pdf);
  EXPECT_LT(result.integral, 1 + 2e-3) << name;
  EXPECT_TRUE(result.passed) << name << ", wo " << wo.x << " " << wo.y << " " << wo.z << ", lobes "
                             << static_cast<int>(lobes) << ": p = " << result.p_value
                             << " at chi2 = " << result.statistic << ", " << result.dof << " degrees of freedom\n"
                             << result.worst;
}

TEST(Sampling, FollowsTheDensity) {
  std::uint64_t seed = 1;
  int tests = 0;
  for (const Named& each : all_materials())
    for (const SurfacePoint& point : {surface(), bent_surface()}) {
      BsdfSlot slot;
      const Bsdf& bsdf = each.material->bsdf(point, slot);
      if (is_specular(bsdf)) continue;
      for (const Vec3& wo : directions())
        for (LobeSet lobes = 1; lobes <= bsdf.all_lobes(); ++lobes) {
          if ((lobes & bsdf.all_lobes()) != lobes) continue;
          expect_agreement(each.name, bsdf, point, wo, lobes, seed++);
          ++tests;
        }
    }
  EXPECT_LE(tests, kTests);
}

}  // namespace
}  // namespace dspm::test
