// What scenes may say about materials: defaults, alternatives, and what is refused.
#include <gtest/gtest.h>

#include "tests/materials/materials.h"

namespace dspm::test {
namespace {

/// All that is said about a material with these parameters.
std::string said(std::string_view type, std::vector<Param> params) {
  Diagnostics diagnostics;
  make(type, std::move(params), diagnostics);
  std::string all;
  for (const Diagnostic& each : diagnostics.all())
    all += std::string(each.severity == Severity::error  ? "error: "
                       : each.severity == Severity::note ? "note: "
                                                         : "warning: ") +
           each.message + "\n";
  return all;
}

int least_lobes(std::string_view type, std::vector<Param> params, float least_alpha) {
  const auto material = make(type, std::move(params));
  BsdfSlot slot;
  return static_cast<int>(material->bsdf(surface(), slot).lobes(least_alpha));
}

/// Whether it can be made without parameters.
bool has_defaults(const Plugin<MakeMaterial>& plugin) { return plugin.name != "measured" && plugin.name != "mix"; }

TEST(Parameters, EveryPluginDescribesItself) {
  const TextureSet textures;
  const auto names = [&](const Plugin<MakeMaterial>& plugin) {
    std::vector<std::string> all;
    for (const ParamInfo& info : describe(plugin, MaterialContext{textures})) all.push_back(info.name);
    return all;
  };
  std::vector<std::string> plugins;
  for (const Plugin<MakeMaterial>& plugin : material_plugins()) {
    plugins.emplace_back(plugin.name);
    EXPECT_EQ(names(plugin).empty(), plugin.name == "interface") << plugin.name;
    EXPECT_EQ(said(plugin.name, {}).empty(), has_defaults(plugin)) << said(plugin.name, {});
  }
  EXPECT_EQ(plugins, (std::vector<std::string>{"coatedconductor", "coateddiffuse", "conductor", "dielectric", "diffuse",
                                               "diffusetransmission", "hair", "interface", "measured", "mix",
                                               "principled", "subsurface", "thindielectric"}));
  EXPECT_EQ(names(*material_plugins().find("conductor")),
            (std::vector<std::string>{"roughness", "uroughness", "vroughness", "remaproughness", "eta", "k",
                                      "reflectance", "energycompensation"}));
}

TEST(Parameters, DiffuseDefault) {
  const auto material = make("diffuse", {});
  BsdfSlot slot;
  EXPECT_NEAR(material->bsdf(surface(), slot).lambertian(1).value()[0], 0.5f / kPi, 1e-7f);
}

TEST(Parameters, BodiesAreOfGlass) {
  for (const Plugin<MakeMaterial>& plugin : material_plugins()) {
    const bool body = plugin.name == "dielectric" || plugin.name == "subsurface";
    if (!has_defaults(plugin)) continue;
    EXPECT_EQ(make(plugin.name, {})->bounds_a_body(), body) << plugin.name;
  }
}

TEST(Parameters, RoughnessIsTheSquareOfAlphaUnlessToldOtherwise) {
  const Param facets_alone = flag("energycompensation", false), alpha = flag("remaproughness", false);
  EXPECT_EQ(least_lobes("conductor", {number("roughness", 0.09f), facets_alone}, 0.299f), 1);
  EXPECT_EQ(least_lobes("conductor", {number("roughness", 0.09f), facets_alone}, 0.301f), 0);
  EXPECT_EQ(least_lobes("conductor", {number("roughness", 0.09f), facets_alone, alpha}, 0.089f), 1);
  EXPECT_EQ(least_lobes("conductor", {number("roughness", 0.09f), facets_alone, alpha}, 0.091f), 0);
  // One direction may be given alone; the other keeps "roughness".
  EXPECT_EQ(least_lobes("dielectric", {number("roughness", 0.25f), number("uroughness", 0.16f), facets_alone}, 0.399f),
            3);
  EXPECT_EQ(least_lobes("dielectric", {number("roughness", 0.25f), number("uroughness", 0.16f), facets_alone}, 0.401f),
            0);
  // Below alpha = 1e-3 a surface is smooth, however little.
  EXPECT_EQ(least_lobes("dielectric", {number("roughness", 0.9e-6f)}, 1e-6f), 0);
  EXPECT_EQ(least_lobes("dielectric", {number("roughness", 1.1e-6f), facets_alone}, 1e-6f), 3);
  // What is made up for light that meets two facets is matte, however smooth they are.
  EXPECT_EQ(least_lobes("conductor", {number("roughness", 0.09f)}, 1), 2);
  EXPECT_EQ(least_lobes("dielectric", {number("roughness", 0.09f)}, 1), 4);
}

TEST(Parameters, NegativeRoughnessIsRefused) {
  for (const char* type : {"conductor", "dielectric", "coateddiffuse"})
    for (const char* name : {"roughness", "uroughness", "vroughness"})
      EXPECT_TRUE(contains(said(type, {number(name, -0.1f)}), "must not be negative")) << type << ' ' << name;
}

TEST(Parameters, TexturesAreLookedUp) {
  TextureSet textures;
  textures.add<Rgb>("red", std::make_shared<ConstantTexture<Rgb>>(Rgb(2, 0.5f, 0)));
  Diagnostics diagnostics;
  const ParamList list{{{ParamType::texture, "reflectance", {}, std::vector<std::string>{"red"}, {}, {}}}};
  ParamReader reader(list, "material \"diffuse\"", {}, diagnostics);
  const auto material = material_plugins().find("diffuse")->make(reader, MaterialContext{textures});
  BsdfSlot slot;
  EXPECT_EQ(material->bsdf(surface(), slot).lambertian(1), Spectrum(1, 0.5f, 0) / kPi);  // clamped to what is possible
  EXPECT_TRUE(diagnostics.all().empty());
}

TEST(Parameters, EtaIsANumberOrOfAGlass) {
  EXPECT_EQ(said("dielectric", {number("eta", 1.33f)}), "");
  const Param bk7{ParamType::spectrum, "eta", {}, std::vector<std::string>{"glass-BK7"}, {}, {}};
  EXPECT_EQ(said("dielectric", {bk7}), "");
  for (const char* type : {"thindielectric", "principled"})
    EXPECT_TRUE(contains(said(type, {bk7}), "has no dispersion: eta is 1.52")) << said(type, {bk7});
  EXPECT_TRUE(contains(said("dielectric", {rgb("eta", {1.5f, 1.6f, 1.7f})}), "eta is 1.6, the mean of its colours"));
  EXPECT_TRUE(contains(said("thindielectric", {number("eta", 0)}), "error: "));
  EXPECT_TRUE(contains(said("hair", {number("eta", -1.55f)}), "must be at least 1"));
}

TEST(Parameters, ConductorsTakeReflectanceOrEtaAndK) {
  EXPECT_TRUE(contains(said("conductor", {rgb("reflectance", Rgb(0.5f)), rgb("k", Rgb(1))}), "error: "));
  EXPECT_EQ(said("conductor", {rgb("eta", Rgb(1)), rgb("k", Rgb(1))}), "");
}

TEST(Parameters, WhatIsNotBuiltIsNamed) {
  for (const Plugin<MakeMaterial>& plugin : material_plugins()) {
    EXPECT_TRUE(contains(said(plugin.name, {number("shine", 1)}), "error: unknown parameter \"shine\"")) << plugin.name;
  }
  for (const std::string_view name : material_plugins().not_built())
    for (const Plugin<MakeMaterial>& plugin : material_plugins()) EXPECT_NE(name, plugin.name);
}

TEST(Parameters, CoatedConductorsHaveTwoOfThem) {
  EXPECT_EQ(said("coatedconductor", {number("interface.eta", 1.4f), number("interface.uroughness", 0.1f),
                                     number("conductor.vroughness", 0.2f), flag("remaproughness", false)}),
            "");
  EXPECT_TRUE(contains(said("coatedconductor", {rgb("reflectance", Rgb(0.5f)), rgb("conductor.k", Rgb(1))}),
                       "takes either \"reflectance\" or \"conductor.eta\" and \"conductor.k\""));
  EXPECT_TRUE(contains(said("coatedconductor", {number("interface.eta", 0)}), "\"interface.eta\""));
  EXPECT_TRUE(contains(said("coatedconductor", {number("g", 0.5f)}), "error: "));
}

TEST(Parameters, SharesLieInTheUnitInterval) {
  for (const char* name : {"metallic", "transmission", "diffusetransmission", "roughness", "anisotropy", "specular",
                           "coat", "coatroughness", "sheenroughness"})
    for (const float value : {-0.1f, 1.1f})
      EXPECT_TRUE(contains(said("principled", {number(name, value)}), "must lie in [0, 1]")) << name;
  EXPECT_TRUE(contains(said("principled", {number("ior", 0.9f)}), "must be at least 1"));
  EXPECT_EQ(said("principled", {number("ior", 1)}), "");
  EXPECT_EQ(said("principled", {rgb("emission", Rgb(7)), number("emissionstrength", 3), number("alpha", 0.5f)}), "");
  EXPECT_TRUE(contains(said("principled", {number("emissionstrength", -1)}), "must not be negative"));
  EXPECT_TRUE(contains(said("principled", {flag("thin", true), rgb("attenuationcolor", Rgb(0.5f))}), "has no inside"));
  EXPECT_FALSE(make("principled", {number("transmission", 1), flag("thin", true)})->bounds_a_body());
  EXPECT_TRUE(make("principled", {number("transmission", 0.1f)})->bounds_a_body());
}

// exp(-absorption distance) is attenuationcolor.
TEST(Parameters, AttenuationIsAbsorption) {
  for (const char* type : {"dielectric", "principled"}) {
    const auto amber = make(type, {rgb("attenuationcolor", {0.9f, 0.5f, 0.1f}), number("attenuationdistance", 2)});
    EXPECT_NEAR(std::exp(-2 * amber->absorption(Palette::rgb())[1]), 0.5f, 1e-6f) << type;
    EXPECT_NEAR(std::exp(-4 * amber->absorption(Palette::rgb())[0]), 0.81f, 1e-6f) << type;
    EXPECT_EQ(make(type, {})->absorption(Palette::rgb()), Spectrum(0));
    EXPECT_TRUE(std::isfinite(make(type, {rgb("attenuationcolor", Rgb(0))})->absorption(Palette::rgb())[0]));
    EXPECT_TRUE(contains(said(type, {number("attenuationdistance", 0)}), "must be above 0"));
  }
}

TEST(Parameters, CoatsHaveNoRandomWalk) {
  EXPECT_TRUE(contains(said("coateddiffuse", {number("g", 0.5f)}), "error: "));
  EXPECT_TRUE(contains(said("coateddiffuse", {rgb("albedo", Rgb(0.1f))}), "error: "));
  EXPECT_EQ(said("coateddiffuse", {number("g", 0), rgb("albedo", Rgb(0))}), "");
  const Param samples{ParamType::integer, "nsamples", {}, std::vector<int>{4}, {}, {}};
  const std::string warned = said("coateddiffuse", {number("thickness", 0.1f), samples});
  EXPECT_EQ(warned, "warning: parameter \"thickness\" of material \"coateddiffuse\" has no effect in dspm\n");
}

}  // namespace
}  // namespace dspm::test
