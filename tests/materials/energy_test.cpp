// No material gives more light than it gets, and what is lost has a reason: albedos (the share of light from one
// direction that leaves again) against 1, against tables of what single scattering off GGX facets loses, and against
// integrals of evaluate, which know nothing of sampling.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "dspm/materials/fresnel.h"
#include "dspm/testing/scattering.h"
#include "tests/materials/materials.h"

namespace dspm::test {
namespace {

/// The share of light that leaves again, of the greatest colour.
double albedo(const Bsdf& bsdf, const Vec3& wo, int samples = 60'000) {
  const PathRandom random(11, Stream::setup, 0, 0);
  return static_cast<double>(max_component(test::albedo(bsdf, wo, Transport::flux, random, samples).mean));
}
double albedo(const Material& material, const Vec3& wo, int samples = 60'000) {
  BsdfSlot slot;
  return albedo(material.bsdf(surface(), slot), wo, samples);
}

/// The integral of f cos over the sphere by a midpoint rule, of the greatest colour.
double integral(const Bsdf& bsdf, const Vec3& wo) {
  constexpr int kRows = 800, kColumns = 800;
  double sums[3] = {};
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const float z = 2 * (static_cast<float>(row) + 0.5f) / kRows - 1;
      const Vec3 wi = direction(z, 2 * kPi * (static_cast<float>(column) + 0.5f) / kColumns);
      const Spectrum f = bsdf.evaluate(wo, wi, Transport::flux, bsdf.all_lobes());
      for (int c = 0; c < 3; ++c) sums[c] += static_cast<double>(f[c] * std::abs(z));
    }
  return *std::max_element(sums, sums + 3) * 4 * std::acos(-1.) / (kRows * kColumns);
}

TEST(Energy, NothingGains) {
  for (const Named& each : all_materials()) {
    const Verdict verdict = gains_nothing(*each.material);
    EXPECT_TRUE(verdict.passed) << each.name << ": " << verdict.message;
  }
}

TEST(Energy, SamplesAndIntegralsAgree) {
  for (const Named& each : all_materials()) {
    BsdfSlot slot;
    const Bsdf& bsdf = each.material->bsdf(surface(), slot);
    const bool narrow = each.name.find("0.0") != std::string::npos;
    if (bsdf.lobes(1e-6f) != bsdf.all_lobes() || narrow) continue;
    for (const Vec3& wo : {direction(0.9f, 1), direction(0.3f, 4), direction(-0.6f, 2)})
      EXPECT_NEAR(albedo(bsdf, wo), integral(bsdf, wo), 0.01) << each.name << " " << wo.z;
  }
}

TEST(Energy, DiffuseReflectsItsReflectance) {
  const auto material = make("diffuse", {rgb("reflectance", {0.1f, 0.7f, 0.3f})});
  for (const Vec3& wo : directions()) EXPECT_NEAR(albedo(*material, wo, 1000), 0.7, 1e-3);
}

TEST(Energy, DiffuseTransmissionSendsAShareToEachSide) {
  const auto shares = [](const std::vector<Param>& params) {
    const auto material = make("diffusetransmission", params);
    BsdfSlot slot;
    const Bsdf& bsdf = material->bsdf(surface(), slot);
    const Vec3 wo = direction(-0.4f, 1);
    const float reflected = bsdf.evaluate(wo, direction(-0.9f, 3), Transport::radiance, 1)[1],
                transmitted = bsdf.evaluate(wo, direction(0.2f, 2), Transport::radiance, 1)[1];
    return Vec2{reflected * kPi, transmitted * kPi};
  };
  const auto expect = [](const Vec2& share, float reflected, float transmitted) {
    EXPECT_NEAR(share.x, reflected, 1e-6);
    EXPECT_NEAR(share.y, transmitted, 1e-6);
  };
  expect(shares({}), 0.25f, 0.25f);
  const Param red = rgb("reflectance", {0, 0.3f, 0}), green = rgb("transmittance", {0, 0.6f, 0});
  expect(shares({red, green}), 0.3f, 0.6f);
  expect(shares({red, green, number("scale", 0.5f)}), 0.15f, 0.3f);
  expect(shares({red, green, number("scale", 3)}), 0.9f / 1.9f, 1 / 1.9f);  // clamped to 0.9 and 1, then to a sum of 1
}

TEST(Energy, SmoothBoundariesLoseNothing) {
  for (const char* type : {"dielectric", "thindielectric"})
    for (const float eta : {1.f, 1.33f, 2.4f}) {
      const auto material = make(type, {number("eta", eta)});
      for (const Vec3& wo : directions()) EXPECT_NEAR(albedo(*material, wo, 1000), 1, 1e-5) << type << eta << wo.z;
    }
}

// A pane of tint t at normal incidence passes (1 - R)^2 t / (1 - t^2 R^2), R = 4%; obliquely light goes further in it.
TEST(Energy, TintOfPanes) {
  const auto material = make("thindielectric", {rgb("tint", {1, 0.5f, 0})});
  BsdfSlot slot;
  const Bsdf& bsdf = material->bsdf(surface(), slot);
  const auto through = [&](float cos) {
    return bsdf.sample(direction(cos, 1), {0, 0, 0.9999f}, Transport::radiance, 2)->weight;
  };
  EXPECT_NEAR(through(1)[0], 0.96 * 0.96 / (1 - 0.0016), 1e-5);
  EXPECT_NEAR(through(1)[1], 0.96 * 0.96 * 0.5 / (1 - 0.25 * 0.0016), 1e-5);
  EXPECT_EQ(through(1)[2], 0);
  EXPECT_NEAR(through(0.5f)[1] / through(0.5f)[0], std::pow(0.5, 1 / std::sqrt(1 - 0.75 / 2.25)), 5e-3);
  const Spectrum mirrored = bsdf.sample({0, 0, 1}, {0, 0, 0}, Transport::radiance, 1)->weight;
  EXPECT_NEAR(mirrored[2], 0.04, 1e-6);
  EXPECT_NEAR(mirrored[0], 0.04 + 0.96 * 0.96 * 0.04 / (1 - 0.0016), 1e-6);
}

// Normal incidence: R = 4%, so R' = R + T^2 R / (1 - R^2) = 2 R / (1 + R) = 7.692%.
TEST(Energy, PanesCountWhatIsReflectedInside) {
  const auto material = make("thindielectric", {});
  BsdfSlot slot;
  const Bsdf& bsdf = material->bsdf(surface(), slot);
  EXPECT_NEAR(bsdf.lobe_probability({0, 0, 1}, 1), 2 * 0.04 / 1.04, 1e-6);
  const auto through = bsdf.sample(direction(0.3f, 2), {0, 0, 0.9999f}, Transport::radiance, 3);
  ASSERT_TRUE(through);
  EXPECT_EQ(through->wi, -direction(0.3f, 2));
}

TEST(Energy, SmoothMetalReflectsFresnel) {
  const auto material = make("conductor", {rgb("reflectance", Rgb(0.6f))});
  EXPECT_NEAR(albedo(*material, {0, 0, 1}, 10), 0.6, 1e-5);
  const auto copper = make("conductor", {});
  BsdfSlot slot;
  const auto drawn = copper->bsdf(surface(), slot).sample(direction(0.5f, 1), {}, Transport::flux, 1);
  ASSERT_TRUE(drawn);
  EXPECT_GT(drawn->weight[0], drawn->weight[1]);
  EXPECT_GT(drawn->weight[1], drawn->weight[2]);
}

// Facets that all but lie flat reflect what a smooth surface does.
TEST(Energy, HardlyRoughIsAsGoodAsSmooth) {
  for (const char* type : {"conductor", "dielectric", "coateddiffuse"}) {
    const auto smooth = make(type, {}), rough = make(type, {alpha(0.0015f)});
    for (const float cos : {1.f, -0.8f, 0.5f})
      EXPECT_NEAR(albedo(*rough, direction(cos, 1)), albedo(*smooth, direction(cos, 1)), 2e-3) << type << " " << cos;
  }
  const auto rough = make("dielectric", {alpha(0.0015f)});
  BsdfSlot slot;
  for (const float cos : {1.f, 0.5f})
    EXPECT_NEAR(rough->bsdf(surface(), slot).lobe_probability(direction(cos, 1), 1), fresnel_dielectric(cos, 1.5f),
                1e-4)
        << cos;
}

struct Loss {
  float alpha;
  double straight, slanted, grazing;  // albedo at cos = 1, 0.5, 0.1
};

// What is left of light that white metal (reflectance 1) scatters once; light that meets a second facet is lost. At
// alpha = 1 and straight on, directions off facets are uniform over the sphere and G2 / G1 = 2 c / (1 + c), whose mean
// over c in [-1, 1], nothing below 0, is 1 - ln 2.
TEST(Energy, LossOfRoughMetal) {
  const Loss table[] = {{0.05f, 0.997, 0.992, 0.910},        {0.1f, 0.988, 0.968, 0.882}, {0.2f, 0.949, 0.896, 0.891},
                        {0.3f, 0.879, 0.822, 0.890},         {0.5f, 0.688, 0.698, 0.861}, {0.7f, 0.503, 0.589, 0.822},
                        {1.f, 1 - std::log(2), 0.450, 0.761}};
  for (const Loss& row : table) {
    const auto metal = make("conductor", {rgb("reflectance", Rgb(1)), alpha(row.alpha), kLossy});
    EXPECT_NEAR(albedo(*metal, direction(1, 0)), row.straight, 3e-3) << row.alpha;
    EXPECT_NEAR(albedo(*metal, direction(0.5f, 0)), row.slanted, 3e-3) << row.alpha;
    EXPECT_NEAR(albedo(*metal, direction(0.1f, 0)), row.grazing, 3e-3) << row.alpha;
  }
}

// The same for glass of index 1.5, reflection and transmission together, from outside and from inside.
TEST(Energy, LossOfRoughGlass) {
  const Loss outside[] = {{0.1f, 0.999, 0.992, 0.922},
                          {0.3f, 0.988, 0.949, 0.906},
                          {0.5f, 0.968, 0.893, 0.853},
                          {1.f, 0.894, 0.742, 0.742}};
  const Loss inside[] = {{0.1f, 0.989, 0.963, 0.863},
                         {0.3f, 0.902, 0.785, 0.786},
                         {0.5f, 0.754, 0.659, 0.689},
                         {1.f, 0.417, 0.512, 0.510}};
  for (const float side : {1.f, -1.f})
    for (const Loss& row : side > 0 ? outside : inside) {
      const auto glass = make("dielectric", {alpha(row.alpha), kLossy});
      EXPECT_NEAR(albedo(*glass, direction(side, 0)), row.straight, 3e-3) << row.alpha << " " << side;
      EXPECT_NEAR(albedo(*glass, direction(0.5f * side, 0)), row.slanted, 3e-3) << row.alpha << " " << side;
      EXPECT_NEAR(albedo(*glass, direction(0.1f * side, 0)), row.grazing, 3e-3) << row.alpha << " " << side;
    }
}

// A white base under a smooth coat: F at once, and (1 - F(wo)) (1 - F_out) / (eta^2 (1 - F_in)) = 1 - F(wo) by the
// base, as (1 - F_out) / eta^2 = 1 - F_in. Nothing is lost.
TEST(Energy, SmoothCoatOverWhiteLosesNothing) {
  for (const float eta : {1.f, 1.1f, 1.5f, 2.4f}) {
    const auto material = make("coateddiffuse", {rgb("reflectance", Rgb(1)), number("eta", eta)});
    for (const Vec3& wo : directions()) EXPECT_NEAR(albedo(*material, wo), 1, 3e-3) << eta << " " << wo.z;
  }
}

/// The least and the most that comes back over directions.
std::pair<double, double> extremes(const Material& material, const std::vector<float>& sides,
                                   const std::vector<float>& azimuths = {1}) {
  double least = 2, most = 0;
  for (const float side : sides)
    for (const float cos : {1.f, 0.7f, 0.4f, 0.2f, 0.05f})
      for (const float phi : azimuths) {
        const double found = albedo(material, direction(side * cos, phi), 10'000);
        least = std::min(least, found), most = std::max(most, found);
      }
  return {least, most};
}

// A rough coat over white, rough metal and rough glass give back all light. Noise is 0.3%, 1% inside glass.
TEST(Energy, CompensatedFacetsLoseNothing) {
  for (const float roughness : {0.01f, 0.1f, 0.3f, 0.6f, 1.f}) {
    const Param rough = number("roughness", roughness), white = rgb("reflectance", Rgb(1));
    const auto metal = extremes(*make("conductor", {white, rough}), {1});
    EXPECT_GE(metal.first, 0.993) << roughness;
    EXPECT_LE(metal.second, 1.006) << roughness;
    for (const float eta : {1.1f, 1.5f, 2.4f}) {
      const auto coat = extremes(*make("coateddiffuse", {white, rough, number("eta", eta)}), {1});
      EXPECT_GE(coat.first, 0.985) << roughness << " " << eta;
      EXPECT_LE(coat.second, 1.006) << roughness << " " << eta;
      const auto glass = extremes(*make("dielectric", {rough, number("eta", eta)}), {1, -1});
      EXPECT_GE(glass.first, 0.98) << roughness << " " << eta;
      EXPECT_LE(glass.second, 1.02) << roughness << " " << eta;
    }
  }
}

// Whichever direction is the rougher, up to scratches that are smooth along themselves: tables know it to a few percent.
TEST(Energy, CompensatedFacetsOfTwoRoughnesses) {
  const std::vector<float> azimuths{0, 0.8f, 1.57f};
  for (const Vec2 rough : {Vec2{0.0225f, 0.25f}, Vec2{0.6f, 0.1f}, Vec2{0, 0.3f}, Vec2{1, 0.01f}}) {
    const Param u = number("uroughness", rough.x), v = number("vroughness", rough.y);
    const Param white = rgb("reflectance", Rgb(1));
    const auto metal = extremes(*make("conductor", {white, u, v}), {1}, azimuths);
    EXPECT_GE(metal.first, 0.95) << rough.x << " " << rough.y;
    EXPECT_LE(metal.second, 1.015) << rough.x << " " << rough.y;
    const auto coat = extremes(*make("coateddiffuse", {white, u, v}), {1}, azimuths);
    EXPECT_GE(coat.first, 0.95) << rough.x << " " << rough.y;
    EXPECT_LE(coat.second, 1.015) << rough.x << " " << rough.y;
    const auto glass = extremes(*make("dielectric", {u, v}), {1, -1}, azimuths);
    const bool are_scratches = std::min(rough.x, rough.y) < 0.01f * std::max(rough.x, rough.y);  // they lose light
    if (!are_scratches) {
      EXPECT_GE(glass.first, 0.9) << rough.x << " " << rough.y;
    }
    EXPECT_LE(glass.second, 1.03) << rough.x << " " << rough.y;
  }
}

// Under a smooth coat of index 1.5, at normal incidence, a base of albedo a gives
// 0.04 + 0.96 (1 - F_in) a / (1 - a F_in), with F_in = 0.5963: 0.2806 for a = 0.5.
TEST(Energy, CoatDarkensTheBase) {
  const auto material = make("coateddiffuse", {rgb("reflectance", Rgb(0.5f))});
  const double inside = 1 - (1 - static_cast<double>(mean_fresnel_outside(1.5f))) / 2.25;
  EXPECT_NEAR(inside, 0.5963, 1e-3);
  EXPECT_NEAR(albedo(*material, {0, 0, 1}), 0.04 + 0.96 * (1 - inside) * 0.5 / (1 - 0.5 * inside), 2e-3);
}

// However little a coat lets in, over white it comes out again.
TEST(Energy, CoatOfAnyIndexLosesNothing) {
  for (const float eta : {1e-4f, 0.5f, 30.f, 1e4f, 1e8f, 1e30f}) {
    const auto material = make("coateddiffuse", {rgb("reflectance", Rgb(1)), number("eta", eta)});
    for (const float cos : {1.f, 0.5f, 0.05f}) EXPECT_NEAR(albedo(*material, direction(cos, 1)), 1, 1e-2) << eta;
  }
}

// The coat mirrors off facets and lets in as if it were smooth: together no more than there is, also where facets
// reflect totally.
TEST(Energy, RoughCoatsOfAnyIndexGainNothing) {
  for (const float eta : {1e-4f, 0.2f, 0.376f, 0.7f, 0.95f, 1.05f, 1.2f, 1.5f, 2.f, 4.f, 100.f})
    for (const Vec2 rough : {Vec2{0.1f, 0.1f}, Vec2{0.4f, 0.4f}, Vec2{1, 1}, Vec2{0.4f, 0}, Vec2{0.02f, 1}}) {
      const auto material = make("coateddiffuse", {rgb("reflectance", Rgb(1)), number("eta", eta),
                                                   number("uroughness", rough.x), number("vroughness", rough.y)});
      const Verdict verdict = gains_nothing(*material);
      EXPECT_TRUE(verdict.passed) << eta << " " << rough.x << " " << rough.y << ": " << verdict.message;
    }
}

}  // namespace
}  // namespace dspm::test
