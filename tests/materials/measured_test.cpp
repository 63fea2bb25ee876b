// Measured materials: files of a surface that is known by formula, and files that are wrong.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/materials/measured/bilinear_warp.h"
#include "dspm/testing/chi2.h"
#include "dspm/testing/scattering.h"
#include "tests/materials/bsdf_file.h"
#include "tests/materials/materials.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace {

constexpr float kAlpha = 0.35f, kReflectance = 0.7f;

Param file(const std::filesystem::path& path) {
  return {ParamType::text, "filename", {}, std::vector{path.string()}, {}, {}};
}

std::shared_ptr<const Material> measured(const std::vector<BsdfTable>& tables) {
  const TemporaryDirectory directory;
  put_file(directory / "a.bsdf", bsdf_file(tables));
  return make("measured", {file(directory / "a.bsdf")});
}

/// What is said about a file.
std::string said(const std::string& contents) {
  const TemporaryDirectory directory;
  put_file(directory / "a.bsdf", contents);
  Diagnostics diagnostics;
  EXPECT_EQ(make("measured", {file(directory / "a.bsdf")}, diagnostics), nullptr);
  return diagnostics.all().empty() ? "" : diagnostics.all().front().message;
}
std::string said(const std::vector<BsdfTable>& tables) { return said(bsdf_file(tables)); }

BsdfTable& named(std::vector<BsdfTable>& tables, const std::string& name) {
  return *std::find_if(tables.begin(), tables.end(), [&](const BsdfTable& table) { return table.name == name; });
}

float formula(const Vec3& wo, const Vec3& wi) {
  return kReflectance * Ggx({kAlpha, kAlpha}).reflection(wo, wi, normalize(wo + wi));
}

TEST(Measured, IsWhatItsFileHolds) {
  const auto material = measured(ggx_tables(kAlpha, {kReflectance, kReflectance}));
  BsdfSlot slot;
  const Bsdf& bsdf = material->bsdf(surface(), slot);
  for (const Vec3& wo : directions_above()) {
    if (wo.z < 0.1f) continue;  // where sigma turns within a cell of its table
    for (const Vec3& wi : {direction(0.95f, 2), direction(0.7f, 4), direction(0.4f, 0.5f)}) {
      const Spectrum f = bsdf.evaluate(wo, wi, Transport::radiance, 1);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(f[c], formula(wo, wi), 0.03f * formula(wo, wi) + 1e-4f) << wo.z;
      EXPECT_EQ(f, bsdf.evaluate(wi, wo, Transport::flux, 1));
      EXPECT_TRUE(is_black(bsdf.evaluate(wo, -wi, Transport::radiance, 1)));
    }
  }
}

TEST(Measured, ScattersAsItSamples) {
  const auto material = measured(ggx_tables(kAlpha, {kReflectance, kReflectance}));
  for (const auto& check : {weights_agree, keeps_to_sides, gains_nothing}) {
    const Verdict verdict = check(*material);
    EXPECT_TRUE(verdict.passed) << verdict.message;
  }
  const Verdict chi2 = samples_follow_density(*material);
  EXPECT_TRUE(chi2.passed) << chi2.message;
}

TEST(Measured, SpectraBecomeColours) {
  const auto material = measured(ggx_tables(kAlpha, {0.1f, 0.1f, 0.1f, 0.9f, 0.9f}));
  BsdfSlot slot;
  const Spectrum f = material->bsdf(surface(), slot).evaluate({0, 0, 1}, direction(0.9f, 1), Transport::radiance, 1);
  EXPECT_GT(f[0], 2 * f[2]);
}

// A straight line over wavelength is the same in wide samples.
TEST(Measured, SpectralRendersTakeItsWavelengths) {
  const auto material = measured(ggx_tables(kAlpha, {0.1f, 0.3f, 0.5f, 0.7f, 0.9f}));  // at 400, 475, ... nm
  const Vec3 wo{0, 0, 1}, wi = direction(0.9f, 1);
  const float white = formula(wo, wi) / kReflectance;
  for (std::uint64_t iteration = 0; iteration < 16; ++iteration) {
    const auto palette = Palette::of_iteration(1, iteration);
    SurfacePoint point = surface();
    point.palette = palette.get();
    BsdfSlot slot;
    const Spectrum f = material->bsdf(point, slot).evaluate(wo, wi, Transport::radiance, 1);
    for (int k = 0; k < 3; ++k) {
      const float expected = 0.1f + 0.8f * static_cast<float>(palette->nm(k) - 400) / 300;
      if (palette->nm(k) < 420 || palette->nm(k) > 680) continue;
      EXPECT_NEAR(f[k], expected * white, 0.04f * white) << palette->nm(k);
    }
  }
}

TEST(Measured, IsAsRoughAsItsFacets) {
  for (const float alpha : {0.1f, 0.35f, 0.8f}) {
    const auto material = measured(ggx_tables(alpha, {1, 1}));
    BsdfSlot slot;
    const Bsdf& bsdf = material->bsdf(surface(), slot);
    EXPECT_EQ(bsdf.lobes(0.9f * alpha), 1) << alpha;
    EXPECT_EQ(bsdf.lobes(1.1f * alpha), 0) << alpha;
  }
}

// A density on a grid of its own for each pair of parameters, in between the mean of its neighbours'.
TEST(BilinearWarp, SamplesFollowItsDensity) {
  const std::vector<float> values{1, 0, 3, 2, 5, 1, 0, 1, 2, 4, 0, 1, 1, 1, 1, 1, 1, 1, 3, 0, 0, 0, 0, 3};
  const BilinearWarp warp(values, 3, 2);
  const GridMix mix = GridParameters({0, 1}, {0, 2}).at(0.25f, 1.5f);
  EXPECT_NEAR(mix.weight[0] + mix.weight[1] + mix.weight[2] + mix.weight[3], 1, 1e-6f);
  constexpr int kSide = 8, kSamples = 400;  // cells of the square, samples along a side of it
  std::vector<double> found(kSide * kSide), expected(kSide * kSide);
  const auto cell = [](const Vec2& p) {
    return static_cast<std::size_t>(std::min(kSide - 1, static_cast<int>(p.y * kSide)) * kSide +
                                    std::min(kSide - 1, static_cast<int>(p.x * kSide)));
  };
  for (int y = 0; y < kSamples; ++y)
    for (int x = 0; x < kSamples; ++x) {
      const Vec2 u{(static_cast<float>(x) + 0.5f) / kSamples, (static_cast<float>(y) + 0.5f) / kSamples};
      const BilinearWarp::Point warped = warp.sample(u, mix);
      EXPECT_NEAR(warped.density, warp.density(warped.p, mix), 1e-3f);
      const BilinearWarp::Point back = warp.invert(warped.p, mix);
      EXPECT_NEAR(back.p.x, u.x, 1e-3f);
      EXPECT_NEAR(back.p.y, u.y, 1e-3f);
      found[cell(warped.p)] += 1. / (kSamples * kSamples);
      expected[cell(u)] += static_cast<double>(warp.density(u, mix)) / (kSamples * kSamples);
    }
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 2e-3) << i;
}

TEST(Measured, WrongFilesAreNamed) {
  const std::vector<BsdfTable> good = ggx_tables(kAlpha, {1, 1}, 8);
  const std::string whole = bsdf_file(good);
  EXPECT_TRUE(contains(said("no measurement at all"), "not a .bsdf file"));
  EXPECT_TRUE(contains(said(whole.substr(0, 40)), "ends too early"));
  EXPECT_TRUE(contains(said(whole.substr(0, whole.size() - 4)), "beyond the end"));
  const auto with = [&](const std::string& name, auto&& change) {
    std::vector<BsdfTable> tables = good;
    change(named(tables, name));
    return said(tables);
  };
  EXPECT_TRUE(contains(with("ndf", [](BsdfTable& t) { t.name = "other"; }), "no table \"ndf\""));
  EXPECT_TRUE(contains(with("ndf", [](BsdfTable& t) { t.shape = {16}; }), "2 dimensions"));
  EXPECT_TRUE(contains(with("vndf", [](BsdfTable& t) { t.values[5] = NAN; }), "holds the number nan"));
  EXPECT_TRUE(contains(with("sigma", [](BsdfTable& t) { t.values[5] = -1; }), "holds the number -1"));
  EXPECT_TRUE(contains(with("theta_i", [](BsdfTable& t) { t.values[1] = 0; }), "does not ascend"));
  EXPECT_TRUE(contains(with("luminance", [](BsdfTable& t) { std::fill_n(t.values.begin(), 6, 0.f); }), "no integral"));
  EXPECT_TRUE(contains(with("spectra", [](BsdfTable& t) { t.shape = {1, 24, 2, 64, 16}; }), "another size"));
  EXPECT_TRUE(contains(with("ndf", [](BsdfTable& t) { t.shape = {std::uint64_t{1} << 40, 8}; }), "too large"));
}

}  // namespace
}  // namespace dspm::test
