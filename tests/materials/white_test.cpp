// White principled materials in a white furnace: they give back all light, whatever their layers, and gain nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dspm/testing/scattering.h"
#include "tests/materials/materials.h"

namespace dspm::test {
namespace {

/// Of the albedos by direction and colour.
struct Albedos {
  double least = 2, most = 0;
};

Albedos albedos(const Material& material, float side, const std::vector<float>& azimuths = {1}) {
  BsdfSlot slot;
  const Bsdf& bsdf = material.bsdf(surface(), slot);
  Albedos all;
  for (const float cos : {1.f, 0.7f, 0.4f, 0.15f, 0.05f})
    for (const float phi : azimuths) {
      const PathRandom random(11, Stream::setup, 0, 0);
      const Spectrum mean = test::albedo(bsdf, direction(side * cos, phi), Transport::flux, random, 10'000).mean;
      all.least = std::min(all.least, static_cast<double>(std::min({mean[0], mean[1], mean[2]})));
      all.most = std::max(all.most, static_cast<double>(max_component(mean)));
    }
  return all;
}

std::unique_ptr<Material> white(std::vector<Param> params) {
  params.push_back(rgb("basecolor", Rgb(1)));
  return make("principled", std::move(params));
}

/// Nothing is gained, and at most `loss` lost, from both sides.
void expect_white(std::vector<Param> params, double loss, const std::string& what) {
  const auto material = white(std::move(params));
  const Verdict verdict = gains_nothing(*material);
  EXPECT_TRUE(verdict.passed) << what << ": " << verdict.message;
  for (const float side : {1.f, -1.f}) EXPECT_GE(albedos(*material, side).least, 1 - loss) << what << " " << side;
}

TEST(White, LosesNothing) {
  for (const float roughness : {0.f, 0.2f, 0.6f, 1.f}) {
    const Param rough = number("roughness", roughness);
    const std::string suffix = " " + std::to_string(roughness);
    expect_white({rough}, 0.01, "opaque" + suffix);
    expect_white({rough, number("specular", 0.3f)}, 0.01, "faint" + suffix);
    for (const float colour : {0.f, 8.f, 25.f})
      expect_white({rough, rgb("specularcolor", Rgb(colour))}, 0.01, "tinted" + suffix);
    expect_white({rough, number("metallic", 1)}, 0.01, "metal" + suffix);
    expect_white({rough, number("transmission", 1)}, 0.02, "glass" + suffix);
    expect_white({rough, number("transmission", 0.5f), number("metallic", 0.5f)}, 0.01, "mixed" + suffix);
    expect_white({rough, number("eta", 2.4f), number("transmission", 0.5f)}, 0.01, "dense" + suffix);
    expect_white({rough, number("transmission", 1), flag("thin", true)}, 0.01, "pane" + suffix);
    expect_white({rough, number("transmission", 0.5f), number("diffusetransmission", 0.6f), flag("thin", true)}, 0.01,
                 "shade" + suffix);
    expect_white({rough, rgb("sheen", Rgb(1)), number("sheenroughness", 0.3f)}, 0.04, "cloth" + suffix);
  }
}

TEST(White, LosesLittleUnderFilms) {
  const std::vector<Param> film{number("iridescence", 1), number("iridescenceeta", 1.8f),
                                number("iridescencethickness", 280)};
  const auto under_film = [&](std::vector<Param> params, double loss, const std::string& what) {
    params.insert(params.end(), film.begin(), film.end());
    expect_white(std::move(params), loss, what);
  };
  for (const float roughness : {0.f, 0.3f, 1.f}) {
    const Param rough = number("roughness", roughness);
    under_film({rough, number("metallic", 1)}, 0.01, "metal");
    under_film({rough, number("transmission", 1)}, 0.02, "glass");
    under_film({rough, number("transmission", 1), flag("thin", true)}, 0.01, "pane");
    under_film({rough}, 0.2, "opaque");  // the ground gets what the brightest colour of any film leaves
  }
}

// Some of it is noise: sheen is rarely sampled at grazing angles. What layers leave to the opaque dielectric is shared out
// as to metal, which loses up to 1.5%.
TEST(White, LosesLittleUnderLayers) {
  const Param varnish = number("coat", 1), dust = rgb("sheen", Rgb(1)), dust_rough = number("sheenroughness", 0.6f);
  for (const float metallic : {0.f, 1.f})
    for (const float roughness : {0.f, 0.35f})
      for (const float coat : {0.f, 0.4f}) {
        const Param metal = number("metallic", metallic), rough = number("roughness", roughness);
        const Param coat_rough = number("coatroughness", coat);
        const std::string what =
            std::to_string(metallic) + " " + std::to_string(roughness) + " " + std::to_string(coat);
        expect_white({metal, rough, varnish, coat_rough}, 0.02, "varnished " + what);
        expect_white({metal, rough, varnish, coat_rough, dust, dust_rough}, 0.035, "varnished and dusty " + what);
        if (coat == 0) expect_white({metal, rough, dust, dust_rough}, 0.035, "dusty " + what);
        if (coat > 0) expect_white({metal, rough, number("coat", 0.5f)}, 0.02, "half varnished " + what);
      }
}

// What layers send back into rough glass is known to 9%.
TEST(White, GlassLosesLittleUnderLayers) {
  const std::vector<Param> layers[] = {{number("coat", 1)},
                                       {number("coat", 1), number("coatroughness", 0.5f)},
                                       {rgb("sheen", Rgb(1)), number("sheenroughness", 0.6f)}};
  for (const float roughness : {0.f, 0.4f, 0.7f, 1.f})
    for (std::vector<Param> params : layers) {
      params.push_back(number("roughness", roughness));
      params.push_back(number("transmission", 1));
      const Albedos outside = albedos(*white(params), 1), inside = albedos(*white(params), -1);
      EXPECT_GE(outside.least, 0.97) << roughness << " " << params.front().name;
      EXPECT_LE(outside.most, 1.01) << roughness << " " << params.front().name;
      EXPECT_GE(inside.least, roughness == 0 ? 0.999 : 0.9) << roughness << " " << params.front().name;
      EXPECT_LE(inside.most, 1.02) << roughness << " " << params.front().name;
      params.push_back(flag("thin", true));
      expect_white(params, 0.02, "pane");
    }
}

// Between tables' entries brushed facets gain a little.
TEST(White, LosesLittleIfBrushed) {
  const std::vector<float> azimuths{0, 0.8f, 1.57f};
  const std::vector<Param> layers{number("coat", 1), rgb("sheen", Rgb(1))};
  for (const float roughness : {0.3f, 0.6f, 1.f})
    for (const float anisotropy : {0.4f, 1.f}) {
      const std::string what = std::to_string(roughness) + " " + std::to_string(anisotropy);
      const std::vector<Param> brushed{number("roughness", roughness), number("anisotropy", anisotropy)};
      const auto expect = [&](std::vector<Param> params, float side, double loss, double gain, const char* of) {
        params.insert(params.end(), brushed.begin(), brushed.end());
        const Albedos found = albedos(*white(params), side, azimuths);
        EXPECT_GE(found.least, 1 - loss) << of << " " << what;
        EXPECT_LE(found.most, 1 + gain) << of << " " << what;
      };
      expect({number("metallic", 1)}, 1, 0.02, 0.01, "metal");
      expect({}, 1, 0.01, 0.01, "plastic");
      expect({number("transmission", 1)}, 1, 0.02, 0.01, "glass");
      expect({number("transmission", 1)}, -1, 0.07, 0.07, "glass from inside");
      expect({number("metallic", 1), layers[0]}, 1, 0.05, 0.02, "varnished");
      expect({number("metallic", 1), layers[1]}, 1, 0.06, 0.02, "dusty");
    }
}

}  // namespace
}  // namespace dspm::test
