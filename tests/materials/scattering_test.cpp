// What sample, pdf_w, evaluate and share of one Bsdf must have to do with each other, for every material.
#include "dspm/testing/scattering.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/materials/fresnel.h"
#include "tests/materials/materials.h"

namespace dspm::test {
namespace {

constexpr std::uint64_t kSeed = 5;

std::string text(const Vec3& v) { return fmt::format("({} {} {})", v.x, v.y, v.z); }

void expect_near(const Spectrum& a, const Spectrum& b, float relative, const std::string& what) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(a[c], b[c], relative * std::max(std::abs(a[c]), std::abs(b[c])) + 5e-6f) << what;
}

/// Calls fn(name, bsdf, point) for every material on a plain and a bent surface.
template <class Fn>
void for_each_bsdf(const Fn& fn) {
  for (const Named& each : all_materials())
    for (const SurfacePoint& point : {surface(), bent_surface()}) {
      BsdfSlot slot;
      fn(each.name, each.material->bsdf(point, slot), point);
    }
}

void expect_of_all(Verdict (*check)(const Material&)) {
  for (const Named& each : all_materials()) {
    const Verdict verdict = check(*each.material);
    EXPECT_TRUE(verdict.passed) << each.name << ": " << verdict.message;
  }
}

TEST(Scattering, WeightIsFCosineOverDensity) { expect_of_all(weights_agree); }

// The sharpest lobes that are still evaluated: a facet's normal is known to 1e-7, alpha is 2e-3.
TEST(Scattering, SharpLobesKeepTheirDigits) {
  for (const char* type : {"conductor", "dielectric", "coateddiffuse"}) {
    const auto material = make(type, {alpha(0.002f)});
    BsdfSlot slot;
    const Bsdf& bsdf = material->bsdf(bent_surface(), slot);
    const PathRandom random(kSeed, Stream::setup, 8, 0);
    for (const Vec3& wo : directions())
      for (int n = 0; n < 1000; ++n) {
        const auto drawn = bsdf.sample(wo, three_numbers(random, n), Transport::radiance, bsdf.all_lobes());
        if (!drawn) continue;
        const float pdf = bsdf.pdf_w(wo, drawn->wi, Transport::radiance, bsdf.all_lobes());
        EXPECT_NEAR(pdf / drawn->pdf_w, 1, 0.02f) << type << text(wo) << text(drawn->wi);
      }
  }
}

TEST(Scattering, KeepsToTheSidesOfBothNormals) { expect_of_all(keeps_to_sides); }

// Where ns turns away from the camera, as much is seen as from the direction's mirror image, and nothing turns black but
// mirrors that reflect the body's own surface.
TEST(Scattering, TheCameraSeesASurfaceThatNsTurnsAway) {
  const SurfacePoint point = bent_surface();
  const Vec3 across = normalize(cross(point.ns, point.ng)), down = cross(across, point.ns);
  const auto along = [&](float up) { return normalize(down * (dot(down, point.ng) > 0 ? 1.f : -1.f) + point.ns * up); };
  for (const Named& each : all_materials()) {
    BsdfSlot slot;
    const Bsdf& bsdf = each.material->bsdf(point, slot);
    const PathRandom random(kSeed, Stream::setup, 10, 0);
    for (const Vec3& w : {along(0.1f), along(0.1f) * -1.f}) {  // from outside and from inside
      const Vec3 twin = w - point.ns * (2 * dot(w, point.ns));
      ASSERT_GT(dot(w, point.ng) * dot(twin, point.ng), 0);
      const auto seen = [&](const Vec3& wo) {
        Spectrum sum;
        for (int n = 0; n < 2000; ++n)
          if (const auto drawn = bsdf.sample(wo, three_numbers(random, n), Transport::radiance, bsdf.all_lobes()))
            sum += drawn->weight / 2000;
        return sum;
      };
      if (!is_specular(bsdf) || each.name.starts_with("principled")) {
        EXPECT_GT(max_component(seen(w)), 0.005f) << each.name;
      }
      expect_near(seen(twin), seen(w), 2e-3f, each.name);
      EXPECT_NEAR(bsdf.lobe_probability(w, 1), bsdf.lobe_probability(twin, 1), 1e-4f) << each.name;
    }
  }
}

TEST(Scattering, NothingGoesAlongTheSurface) {
  for (const Named& each : all_materials()) {
    BsdfSlot slot;
    const Bsdf& bsdf = each.material->bsdf(surface(), slot);
    for (const Vec3& along : {Vec3{1, 0, 0}, Vec3{0, -1, 0}})
      for (const Vec3& w : directions()) {
        EXPECT_EQ(bsdf.evaluate(w, along, Transport::radiance, bsdf.all_lobes()), Spectrum(0)) << each.name << text(w);
        EXPECT_EQ(bsdf.pdf_w(w, along, Transport::radiance, bsdf.all_lobes()), 0) << each.name << text(w);
      }
  }
}

// Under a coat that mirrors 4% a black base would take 96% of the paths; bases that are about as bright choose alike.
TEST(Scattering, ADarkBaseLeavesPathsToTheCoat) {
  const auto share_of_coat = [](float reflectance) {
    const auto material = make("coateddiffuse", {rgb("reflectance", Rgb(reflectance))});
    BsdfSlot slot;
    return material->bsdf(surface(), slot).lobe_probability({0, 0, 1}, 1);
  };
  EXPECT_NEAR(share_of_coat(0.8f), 0.04f, 1e-3f);
  EXPECT_EQ(share_of_coat(0.8f), share_of_coat(0.4f));
  EXPECT_NEAR(share_of_coat(0.01f), 0.04f / (0.04f + 0.96f / 16), 1e-2f);
  EXPECT_EQ(share_of_coat(0.01f), share_of_coat(0));
}

// All lobes together are the sum of each alone; lobes that do not exist add nothing.
TEST(Scattering, LobesAddUp) {
  for_each_bsdf([](const std::string& name, const Bsdf& bsdf, const SurfacePoint&) {
    const PathRandom random(kSeed, Stream::setup, 3, 0);
    for (int n = 0; n < 300; ++n) {
      const Vec3 wo = any_direction(random, n), wi = any_direction(random, 1000 + n);
      Spectrum sum;
      for (const LobeSet lobe : std::initializer_list<LobeSet>{1, 2, 4, 8, 128})
        sum += bsdf.evaluate(wo, wi, Transport::flux, lobe);
      expect_near(sum, bsdf.evaluate(wo, wi, Transport::flux, bsdf.all_lobes()), 1e-5f, name);
      const LobeSet none = static_cast<LobeSet>(~bsdf.all_lobes());
      EXPECT_FALSE(bsdf.sample(wo, three_numbers(random, n), Transport::flux, none)) << name;
      EXPECT_EQ(bsdf.pdf_w(wo, wi, Transport::flux, none), 0) << name;
      EXPECT_EQ(bsdf.lobe_probability(wo, none), 0) << name;
    }
  });
}

// How often sampling everything would choose a lobe: sampling all lobes with a stratified u.z takes the reflecting (coat)
// lobe where u.z is below its probability.
TEST(Scattering, SharesAreTheChancesOfLobes) {
  for_each_bsdf([](const std::string& name, const Bsdf& bsdf, const SurfacePoint& point) {
    for (const Vec3& wo : directions()) {
      if (dot(wo, point.ns) * dot(wo, point.ng) <= 0) continue;
      const LobeSet all = bsdf.all_lobes();
      EXPECT_NEAR(bsdf.lobe_probability(wo, all), 1, 1e-6f) << name;
      if (all != 3) continue;
      EXPECT_NEAR(bsdf.lobe_probability(wo, 1) + bsdf.lobe_probability(wo, 2), 1, 1e-6f) << name;
      if (is_specular(bsdf)) {
        const float edge = bsdf.lobe_probability(wo, 1);
        const auto reflected = bsdf.sample(wo, {0.3f, 0.7f, edge - 1e-5f}, Transport::flux, all);
        const auto passed = bsdf.sample(wo, {0.3f, 0.7f, edge + 1e-5f}, Transport::flux, all);
        if (reflected && edge > 1e-5f) {
          EXPECT_GT(dot(reflected->wi, point.ng) * dot(wo, point.ng), 0) << name;
        }
        if (passed && edge < 1 - 1e-5f) {
          EXPECT_LT(dot(passed->wi, point.ng) * dot(wo, point.ng), 0) << name;
        }
      }
    }
  });
}

// A rough boundary chooses by the Fresnel reflectance of the facet that was sampled; lobe_probability() is its mean.
TEST(Scattering, SharesOfRoughGlass) {
  for (const float a : {0.1f, 0.5f, 1.f}) {
    const auto material = make("dielectric", {alpha(a)});
    BsdfSlot slot;
    const Bsdf& bsdf = material->bsdf(surface(), slot);
    for (const Vec3& wo : directions()) {
      const PathRandom random(kSeed, Stream::setup, 4, 0);
      // The weight of a reflection is G2 / G1 for both lobes, and F G2 / G1 for reflection alone.
      double sum = 0;
      int count = 0;
      for (int n = 0; n < 100'000; ++n) {
        Vec3 u = three_numbers(random, n);
        u.z = 0;
        const auto alone = bsdf.sample(wo, u, Transport::flux, 1), both = bsdf.sample(wo, u, Transport::flux, 3);
        if (!alone || !both) continue;
        sum += static_cast<double>(alone->weight[0] / both->weight[0]);
        ++count;
      }
      if (count == 100'000) {
        EXPECT_NEAR(sum / count, bsdf.lobe_probability(wo, 1), 3e-3) << a << text(wo);
      }
    }
  }
}

// Choosing a subset with the chance of its share, and dividing by it, estimates the same as sampling everything.
TEST(Scattering, SubsetsOverSharesEstimateTheWhole) {
  for_each_bsdf([](const std::string& name, const Bsdf& bsdf, const SurfacePoint&) {
    const LobeSet all = bsdf.all_lobes();
    if ((all & (all - 1)) == 0) return;
    const PathRandom random(kSeed, Stream::setup, 5, 0);
    for (const Vec3& wo : directions()) {
      double whole = 0, parts = 0;
      constexpr int kSamples = 20'000;
      for (int n = 0; n < kSamples; ++n) {
        const Vec3 u = three_numbers(random, n);
        if (const auto drawn = bsdf.sample(wo, u, Transport::flux, all)) whole += static_cast<double>(drawn->weight[1]);
        for (const LobeSet lobe :
             std::initializer_list<LobeSet>{1, 2, 4, 8})  // the share cancels: chosen with it, divided by it
          if (const auto drawn = bsdf.sample(wo, u, Transport::flux, lobe))
            parts += static_cast<double>(drawn->weight[1]);
      }
      EXPECT_NEAR(whole / kSamples, parts / kSamples, 0.02) << name << text(wo);
    }
  });
}

TEST(Scattering, Reciprocity) { expect_of_all(is_reciprocal); }

// Through a boundary f / eta^2 of wo's side is symmetric. [Veach 1997, 5.2]
TEST(Scattering, ReciprocityThroughBoundaries) {
  const PathRandom random(kSeed, Stream::setup, 6, 0);
  for (const float eta : {1.5f, 2.4f, 0.75f}) {
    const auto glass = make("dielectric", {number("eta", eta), alpha(0.4f)});
    BsdfSlot slot;
    const Bsdf& bsdf = glass->bsdf(surface(), slot);
    for (int n = 0; n < 2000; ++n) {
      const Vec3 wo = any_direction(random, n), wi = any_direction(random, 10'000 + n);
      const float eta_o = wo.z > 0 ? 1 : eta, eta_i = wi.z > 0 ? 1 : eta;
      const Spectrum forth = bsdf.evaluate(wo, wi, Transport::radiance, bsdf.all_lobes());
      const Spectrum back = bsdf.evaluate(wi, wo, Transport::radiance, bsdf.all_lobes());
      expect_near(forth / (eta_o * eta_o), back / (eta_i * eta_i), 2e-3f, text(wo) + text(wi));
    }
  }
}

TEST(Scattering, SmoothGlassScalesRadianceAlone) {
  const auto material = make("dielectric", {});
  BsdfSlot slot;
  const Bsdf& bsdf = material->bsdf(surface(), slot);
  for (const Vec3& wo : directions()) {
    const float eta = wo.z > 0 ? 1.5f : 1 / 1.5f;
    const auto radiance = bsdf.sample(wo, {0.5f, 0.5f, 0.999999f}, Transport::radiance, 3);
    const auto flux = bsdf.sample(wo, {0.5f, 0.5f, 0.999999f}, Transport::flux, 3);
    ASSERT_TRUE(radiance && flux);
    EXPECT_EQ(flux->weight, Spectrum(1));
    const bool through = flux->wi.z * wo.z < 0;
    EXPECT_NEAR(radiance->weight[0], through ? 1 / (eta * eta) : 1, 1e-6f);
    if (through) {
      EXPECT_NEAR(length(Vec3{wo.x, wo.y, 0} + eta * Vec3{flux->wi.x, flux->wi.y, 0}), 0, 1e-6f);
    } else {
      EXPECT_NEAR(length(flux->wi - Vec3{-wo.x, -wo.y, wo.z}), 0, 1e-6f);
    }
  }
}

TEST(Scattering, LobesByRoughness) {
  const auto lobes = [](const char* type, std::vector<Param> params, float least_alpha) {
    BsdfSlot slot;
    return static_cast<int>(make(type, std::move(params))->bsdf(surface(), slot).lobes(least_alpha));
  };
  EXPECT_EQ(lobes("diffuse", {}, 0.9f), 1);
  for (const char* type : {"conductor", "dielectric", "thindielectric"}) EXPECT_EQ(lobes(type, {}, 1e-3f), 0) << type;
  EXPECT_EQ(lobes("conductor", {}, 0), 1);
  EXPECT_EQ(lobes("dielectric", {}, 0), 3);
  EXPECT_EQ(lobes("thindielectric", {}, 0), 3);
  const Param facets_alone = flag("energycompensation", false);
  EXPECT_EQ(lobes("dielectric", {alpha(0.3f), facets_alone}, 0.29f), 3);
  EXPECT_EQ(lobes("dielectric", {alpha(0.3f), facets_alone}, 0.31f), 0);
  EXPECT_EQ(lobes("conductor", {number("uroughness", 0.01f), number("vroughness", 0.25f), facets_alone}, 0.2f), 0);
  EXPECT_EQ(lobes("coateddiffuse", {}, 0), 3);
  EXPECT_EQ(lobes("coateddiffuse", {}, 1e-3f), 2);
  EXPECT_EQ(lobes("coateddiffuse", {alpha(0.3f)}, 0.2f), 3);
  EXPECT_EQ(lobes("coateddiffuse", {alpha(0.3f)}, 0.4f), 2);
}

// Gathering relies on it: where lambertian() answers, it is what evaluate says wherever light arrives at all.
TEST(Scattering, LambertianIsEvaluate) {
  for_each_bsdf([](const std::string& name, const Bsdf& bsdf, const SurfacePoint& point) {
    const std::optional<Spectrum> f = bsdf.lambertian(bsdf.all_lobes());
    EXPECT_EQ(f.has_value(), name == "diffuse");
    if (!f) return;
    const PathRandom random(kSeed, Stream::setup, 7, 0);
    for (int n = 0; n < 1000; ++n) {
      const Vec3 wo = any_direction(random, n), wi = any_direction(random, 5000 + n);
      const bool arrives = dot(wi, point.ng) * dot(wo, point.ng) > 0 && dot(wi, point.ng) * dot(wi, point.ns) > 0;
      EXPECT_EQ(bsdf.evaluate(wo, wi, Transport::radiance, 1), arrives ? *f : Spectrum(0));
    }
  });
}

// Frames whose scattering is said to be that of another frame times a colour gather once for both.
TEST(Scattering, ARatioHoldsForAllDirections) {
  std::vector<Named> materials = all_materials();
  for (const float eta : {1.3f, 1.5f})
    for (const float a : {0.f, 0.3f})
      for (const float r : {0.2f, 0.6f})
        materials.push_back(
            {"coat " + std::to_string(eta) + " " + std::to_string(a) + " " + std::to_string(r),
             make("coateddiffuse", {rgb("reflectance", {r, 0.5f, 0.3f}), number("eta", eta), alpha(a)})});
  const PathRandom random(kSeed, Stream::setup, 9, 0);
  int ratios = 0;
  for (const Named& one : materials)
    for (const Named& other : materials) {
      BsdfSlot slots[2];
      const Bsdf &a = one.material->bsdf(surface(), slots[0]), &b = other.material->bsdf(surface(), slots[1]);
      for (const LobeSet lobes : subsets_of(a.all_lobes())) {
        const std::optional<Spectrum> ratio = a.ratio_to(b, lobes);
        if (!ratio || &one == &other) continue;
        ++ratios;
        for (int n = 0; n < 100; ++n) {
          const Vec3 wo = any_direction(random, n), wi = any_direction(random, 1000 + n);
          expect_near(a.evaluate(wo, wi, Transport::radiance, lobes),
                      b.evaluate(wo, wi, Transport::radiance, lobes) * *ratio, 1e-4f, one.name + ", " + other.name);
        }
      }
    }
  EXPECT_GT(ratios, 20);
}

}  // namespace
}  // namespace dspm::test
