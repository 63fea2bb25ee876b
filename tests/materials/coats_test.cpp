// Coats against a slow twin: pbrt-v4's random walk between the coat and what it covers, by the algorithm that its book
// documents (Pharr, Jakob and Humphreys 2023, 14.3): light enters, loses exp(-thickness / cos) on each way through the
// coat, is scattered at the layers in turn, and is given up after maxdepth of these.
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/testing/scattering.h"
#include "tests/materials/materials.h"

namespace dspm::test {
namespace {

/// What the walk loses at facets, it loses.

struct Layers {
  std::unique_ptr<Material> coat, base;
  float thickness = 0;
  int max_depth = 10;
};

/// What comes back of light from wo, by one walk.
Spectrum walk(const Layers& layers, const Vec3& wo, const PathRandom& random, int n) {
  BsdfSlot slots[2];
  const Bsdf &coat = layers.coat->bsdf(surface(), slots[0]), &base = layers.base->bsdf(surface(), slots[1]);
  const auto numbers = [&](int depth) {
    const Vec2 pair = random.pair(64 * n + depth, 0);
    return Vec3{pair.x, pair.y, random.number(64 * n + depth, 2)};
  };
  const auto entered = coat.sample(wo, numbers(0), Transport::flux, coat.all_lobes());
  if (!entered || entered->wi.z > 0) return entered ? entered->weight : Spectrum();
  Spectrum left = entered->weight;
  Vec3 w = entered->wi;
  for (int depth = 0; depth < layers.max_depth; ++depth) {
    left *= std::exp(-layers.thickness / std::abs(w.z));
    const Bsdf& layer = w.z < 0 ? base : coat;
    const auto drawn = layer.sample(-w, numbers(depth + 1), Transport::flux, layer.all_lobes());
    if (!drawn) return {};
    left *= drawn->weight;
    if (w.z > 0 && drawn->wi.z > 0) return left;
    w = drawn->wi;
  }
  return {};
}

Spectrum walked(const Layers& layers, const Vec3& wo) {
  constexpr int kWalks = 40'000;
  const PathRandom random(3, Stream::setup, 20, 0);
  Spectrum sum;
  for (int n = 0; n < kWalks; ++n) sum += walk(layers, wo, random, n);
  return sum / kWalks;
}

/// Of a material as it is in .pbrt files.
Spectrum albedo_in_pbrt(const char* type, std::vector<Param> params, const Vec3& wo) {
  const TextureSet textures;
  Diagnostics diagnostics;
  const ParamList list{std::move(params)};
  ParamReader reader(list, "material", {}, diagnostics);
  const auto material =
      material_plugins().find(type)->make(reader, MaterialContext{textures, MaterialSet::none(), true});
  EXPECT_TRUE(diagnostics.all().empty());
  BsdfSlot slot;
  return test::albedo(material->bsdf(surface(), slot), wo, Transport::flux, PathRandom(4, Stream::setup, 0, 0), 40'000)
      .mean;
}

TEST(Coats, CoatedDiffuseInPbrtFilesIsTheMeanOfTheWalk) {
  struct Case {
    float alpha, thickness;
    int max_depth;
  };
  for (const Case& c :
       {Case{0, 0.01f, 10}, Case{0, 0.2f, 10}, Case{0, 0.01f, 4}, Case{0.1f, 0.01f, 10}, Case{0.4f, 0.01f, 10}}) {
    const Param depth{ParamType::integer, "maxdepth", {}, std::vector<int>{c.max_depth}, {}, {}};
    const Spectrum base(0.5f, 0.9f, 0.1f);
    const Layers layers{make("dielectric", {alpha(c.alpha), kLossy}), make("diffuse", {rgb("reflectance", base)}),
                        c.thickness, c.max_depth};
    for (const float cos : {1.f, 0.6f, 0.2f}) {
      const Vec3 wo = direction(cos, 1);
      const Spectrum slow = walked(layers, wo),
                     ours = albedo_in_pbrt(
                         "coateddiffuse",
                         {rgb("reflectance", base), alpha(c.alpha), number("thickness", c.thickness), depth}, wo);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(ours[i], slow[i], 0.012)
            << c.alpha << " " << c.thickness << " " << c.max_depth << " " << cos << " " << i;
    }
  }
}

// What a smooth coat of thickness 0 would do without end is what other files get.
TEST(Coats, WithoutLossesTheWalkIsTheSeries) {
  const Layers layers{make("dielectric", {}), make("diffuse", {rgb("reflectance", Rgb(0.8f))}), 0, 62};
  const auto coated = make("coateddiffuse", {rgb("reflectance", Rgb(0.8f))});
  BsdfSlot slot;
  for (const float cos : {1.f, 0.4f}) {
    const Vec3 wo = direction(cos, 1);
    const Spectrum ours =
        test::albedo(coated->bsdf(surface(), slot), wo, Transport::flux, PathRandom(4, Stream::setup, 0, 0), 40'000)
            .mean;
    EXPECT_NEAR(ours[0], walked(layers, wo)[0], 0.01) << cos;
  }
}

// White metal gives back all light, whatever the two are like.
TEST(Coats, WhiteMetalLosesNothing) {
  for (const float coat : {0.f, 0.1f, 0.4f})
    for (const float metal : {0.f, 0.1f, 0.3f, 0.8f}) {
      const auto material =
          make("coatedconductor", {rgb("reflectance", Rgb(1)), number("interface.roughness", coat * coat),
                                   number("conductor.roughness", metal * metal)});
      BsdfSlot slot;
      const Bsdf& bsdf = material->bsdf(surface(), slot);
      for (const float cos : {1.f, 0.5f, 0.15f}) {
        const float albedo =
            test::albedo(bsdf, direction(cos, 1), Transport::flux, PathRandom(4, Stream::setup, 0, 0), 10'000).mean[1];
        EXPECT_LE(albedo, 1.01) << coat << " " << metal << " " << cos;
        EXPECT_GE(albedo, 0.95) << coat << " " << metal << " " << cos;
      }
    }
}

// A mirror under a coat is a series that is known. Rough metal in a .pbrt file loses what meets two facets, as the walk
// does, and all that the coat keeps in by total reflection, which the walk loses for the most part.
TEST(Coats, CoatedConductorAndTheWalk) {
  const Spectrum reflectance(0.9f, 0.6f, 0.3f);
  Spectrum k;  // in the coat, where metal mirrors less
  for (int c = 0; c < 3; ++c) k[c] = 2 * std::sqrt(reflectance[c] / (1 - reflectance[c])) / 1.5f;
  for (const float metal : {0.f, 0.1f, 0.3f}) {
    const Layers layers{make("dielectric", {}),
                        make("conductor", {rgb("eta", Rgb(1 / 1.5f)), rgb("k", k), alpha(metal), kLossy}), 0.01f, 10};
    for (const float cos : {1.f, 0.5f}) {
      const Vec3 wo = direction(cos, 1);
      const Spectrum slow = walked(layers, wo),
                     ours = albedo_in_pbrt(
                         "coatedconductor",
                         {rgb("reflectance", reflectance), number("conductor.roughness", metal * metal)}, wo);
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(ours[c], slow[c] * (metal == 0 ? 1 : 0.8f) - 0.01f) << metal << " " << cos << " " << c;
        EXPECT_LE(ours[c], slow[c] + 0.01f) << metal << " " << cos << " " << c;
      }
    }
  }
}

}  // namespace
}  // namespace dspm::test
