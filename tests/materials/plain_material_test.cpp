// Plain materials, against those that they are of: their Bsdfs answer the same, to the bit, and what they cannot say makes
// that there are none.
#include "dspm/materials/plain_material.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "dspm/materials/mix.h"
#include "dspm/materials/refractive_index.h"
#include "dspm/materials/relief.h"
#include "tests/materials/materials.h"
#include "tests/textures/make.h"

namespace dspm::test {
namespace {

class Bits {
 public:
  void add(float value) { all_.push_back(std::bit_cast<std::uint32_t>(value)); }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const Spectrum& s) { add(s[0]), add(s[1]), add(s[2]); }
  void add(bool flag) { all_.push_back(flag); }
  void add(LobeSet lobes) { all_.push_back(lobes); }
  void add(const BsdfSample& sample) {
    add(sample.wi), add(sample.weight), add(sample.pdf_w), add(sample.specular), add(sample.eta_scale);
    add(sample.ahead.has_value()), add(sample.by_wavelength);
  }
  template <class T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  friend bool operator==(const Bits&, const Bits&) = default;

 private:
  std::vector<std::uint32_t> all_;
};

PathRandom random_numbers(int index) { return {7, Stream::photon, static_cast<std::uint64_t>(index), 0}; }

/// All that a Bsdf, plain or not, answers for random directions and numbers.
template <class AnyBsdf>
Bits answers(const AnyBsdf& bsdf, int index) {
  const PathRandom random = random_numbers(index);
  const Vec3 wo = any_direction(random, 0), wi = any_direction(random, 1), u = three_numbers(random, 2);
  Bits bits;
  for (const float least_alpha : {0.f, 1e-6f, 0.3f}) bits.add(bsdf.lobes(least_alpha));
  for (const LobeSet lobes : subsets_of(bsdf.lobes(0))) {
    for (const Transport transport : {Transport::radiance, Transport::flux}) {
      const auto sample = bsdf.sample(wo, u, transport, lobes);
      bits.add(sample);
      for (const Vec3& w : {wi, sample ? sample->wi : wo}) {
        bits.add(bsdf.evaluate(wo, w, transport, lobes));
        bits.add(bsdf.pdf_w(wo, w, transport, lobes));
        bits.add(bsdf.disperses(wo, w));
      }
    }
    bits.add(bsdf.lobe_probability(wo, lobes));
    bits.add(bsdf.transmits(lobes));
    bits.add(bsdf.lambertian(lobes));
  }
  return bits;
}

/// A point whose shading normal leans, and which paths of some wavelength have met.
SurfacePoint random_point(int index, const Palette& palette) {
  const PathRandom random = random_numbers(index);
  const Vec3 ng = any_direction(random, 10), other = any_direction(random, 11);
  SurfacePoint point = surface();
  point.p = three_numbers(random, 12) * 9;
  point.ng = ng, point.ns = index % 4 == 0 ? ng : normalize(ng + other * 0.8f);
  point.dpdu = any_direction(random, 13), point.uv = random.pair(14, 0);
  point.palette = &palette;
  if (index % 3 > 0) point.wavelength = {.nm = 360, .alone = index % 2 == 0, .weighs = index % 5 < 3};
  if (index % 3 > 0) point.wavelength.nm += static_cast<std::int16_t>(470 * random.number(15, 0));
  if (!palette.is_rgb()) point.wavelength.nm = static_cast<std::int16_t>(-point.wavelength.nm);
  return point;
}

void expect_same_answers(const Material& material, const Palette& palette, const std::string& name,
                         const PlainIndex& outside = {}) {
  const std::optional<PlainMaterial> plain = material.plain(palette, outside);
  ASSERT_TRUE(plain) << name;
  for (int i = 0; i < 200; ++i) {
    SurfacePoint point = random_point(i, palette);
    point.outside_eta = outside.mean, point.outside_dispersion = outside.at(point.wavelength) / outside.mean;
    BsdfSlot slot;
    const Bits expected = answers(material.bsdf(point, slot), i);
    const HuedWavelength wavelength(point.wavelength);
    ASSERT_TRUE(plain->with_bsdf(point, wavelength, [&](const auto& bsdf) { return answers(bsdf, i); }) == expected)
        << name << ", point " << i << (palette.is_rgb() ? "" : ", spectral");
  }
}
void expect_same_answers(const Material& material, const std::string& name) {
  expect_same_answers(material, Palette::rgb(), name);
  expect_same_answers(material, *Palette::of_iteration(3, 5), name);
}

/// Draws parameters.
class Draw {
 public:
  explicit Draw(int index) : random_(random_numbers(1000 + index)) {}

  float between(float a, float b) { return a + (b - a) * random_.number(n_++, 0); }
  Param colour(const std::string& name) { return rgb(name, Rgb(between(0, 1), between(0, 1), between(0, 1))); }
  Param spectrum(const std::string& name) {
    return {ParamType::spectrum,
            name,
            {},
            std::vector<float>{400, between(0, 1), 550, between(0, 1), 700, between(0, 1)},
            {},
            {}};
  }

 private:
  PathRandom random_;
  int n_ = 0;
};

TEST(PlainMaterial, Diffuse) {
  for (int i = 0; i < 8; ++i) {
    Draw draw(i);
    expect_same_answers(*make("diffuse", {i % 2 == 0 ? draw.colour("reflectance") : draw.spectrum("reflectance")}),
                        "diffuse");
  }
}

TEST(PlainMaterial, ThinDielectric) {
  for (int i = 0; i < 8; ++i) {
    Draw draw(i);
    expect_same_answers(*make("thindielectric", {number("eta", draw.between(0.7f, 2.5f)),
                                                 i % 2 == 0 ? draw.colour("tint") : draw.spectrum("tint")}),
                        "thin dielectric");
  }
}

/// Smooth, of facets equally rough in both directions, and brushed.
std::vector<std::vector<Param>> roughnesses(Draw& draw) {
  const float u = draw.between(0.01f, 1), v = draw.between(0.01f, 1);
  return {{},
          {number("roughness", u)},
          {number("roughness", v), flag("remaproughness", false), kLossy},
          {number("uroughness", u), number("vroughness", v)}};
}

TEST(PlainMaterial, Conductor) {
  for (int i = 0; i < 4; ++i) {
    Draw draw(i);
    for (std::vector<Param> params : roughnesses(draw)) {
      if (i % 2 == 0) params.push_back(i == 0 ? draw.colour("reflectance") : draw.spectrum("reflectance"));
      if (i == 1) params.insert(params.end(), {draw.colour("eta"), draw.spectrum("k")});
      expect_same_answers(*make("conductor", params), "conductor");
    }
  }
}

TEST(PlainMaterial, Dielectric) {
  for (int i = 0; i < 3; ++i) {
    Draw draw(i);
    const float etas[] = {1.35f, 1.02f, draw.between(0.7f, 0.8f)};  // tables of others would take longer
    for (std::vector<Param> params : roughnesses(draw)) {
      params.push_back(number("eta", etas[i]));
      expect_same_answers(*make("dielectric", params), "dielectric");
      params.push_back(number("abbe", 20));
      expect_same_answers(*make("dielectric", params), "dielectric that disperses");
    }
  }
  expect_same_answers(*make("dielectric", {number("eta", 1), alpha(0.3f)}), "dielectric that is not there");
  expect_same_answers(*make("dielectric", {text("glass", "SF11")}), "flint glass");
}

TEST(PlainMaterial, CoatedDiffuse) {
  const float etas[] = {1.5f, 0.8f, 4.5f, 1};
  for (int i = 0; i < 4; ++i) {
    Draw draw(i);
    for (std::vector<Param> params : roughnesses(draw)) {
      params.insert(params.end(),
                    {number("eta", etas[i]), i % 2 == 0 ? draw.colour("reflectance") : draw.spectrum("reflectance")});
      expect_same_answers(*make("coateddiffuse", params), "coated diffuse");
    }
  }
  for (const float roughness : {0.f, 0.3f})
    expect_same_answers(*make("coateddiffuse", {number("roughness", roughness), number("thickness", 0.2f),
                                                integer_param("maxdepth", 3), kLossy}),
                        "coated diffuse as in pbrt");
}

TEST(PlainMaterial, CoatedConductor) {
  const float etas[] = {1.5f, 0.8f};
  for (int i = 0; i < 2; ++i) {
    Draw draw(i);
    for (const std::vector<Param>& coat : roughnesses(draw))
      for (const float metal : {0.f, draw.between(0.01f, 1)}) {
        std::vector<Param> params{number("interface.eta", etas[i]), number("conductor.roughness", metal)};
        for (Param param : coat) {
          if (contains(param.name, "roughness") && param.name != "remaproughness")
            param.name = "interface." + param.name;
          params.push_back(param);
        }
        if (i == 1) params.push_back(draw.colour("reflectance"));
        expect_same_answers(*make("coatedconductor", params), "coated conductor");
      }
  }
}

TEST(PlainMaterial, DiffuseTransmission) {
  for (int i = 0; i < 8; ++i) {
    Draw draw(i);
    expect_same_answers(*make("diffusetransmission", {draw.spectrum("reflectance"), draw.colour("transmittance"),
                                                      number("scale", draw.between(0, 2))}),
                        "diffuse transmission");
  }
}

std::shared_ptr<const Material> part(const char* type) { return make(type, {}); }
TexturePtr<float> amount_of(float share) { return std::make_shared<ConstantTexture<float>>(share); }

TEST(PlainMaterial, Mix) {
  for (const float share : {-1.f, 0.f, 0.3f, 0.8f, 1.f, 2.f})
    expect_same_answers(MixMaterial({part("diffuse"), part("coatedconductor")}, amount_of(share)), "mix");
  const MixMaterial with_glass({part("diffuse"), part("dielectric")}, amount_of(0.5f));
  expect_same_answers(with_glass, Palette::rgb(), "mix in water", PlainIndex{1.33f});
}

TEST(PlainMaterial, NotOfMixesOfWhatHasNone) {
  const auto mix = [](std::shared_ptr<const Material> first, std::shared_ptr<const Material> second) {
    return std::make_unique<MixMaterial>(MixMaterial::Parts{std::move(first), std::move(second)}, amount_of(0.5f));
  };
  const auto plain = mix(part("diffuse"), part("conductor"));
  EXPECT_TRUE(plain->plain(Palette::rgb()));
  EXPECT_FALSE(mix(part("diffuse"), part("hair"))->plain(Palette::rgb()));
  EXPECT_FALSE(mix(part("hair"), part("diffuse"))->plain(Palette::rgb()));
  EXPECT_FALSE(mix(part("diffuse"), mix(part("diffuse"), part("conductor")))->plain(Palette::rgb()));
  plain->set_opacities({amount_of(0.5f), nullptr});
  EXPECT_FALSE(plain->plain(Palette::rgb()));
}

std::optional<PlainMaterial> plain_of(const Material& material) { return material.plain(Palette::rgb()); }

/// Those that are made of no other material.
constexpr std::string_view kPlainPlugins[] = {
    "diffuse", "dielectric", "conductor", "thindielectric", "coateddiffuse", "coatedconductor", "diffusetransmission"};

TEST(PlainMaterial, OnlyOfSomePlugins) {
  for (const Plugin<MakeMaterial>& plugin : material_plugins()) {
    if (plugin.name == "measured" || plugin.name == "mix") continue;
    EXPECT_EQ(plain_of(*make(plugin.name, {})).has_value(), std::ranges::count(kPlainPlugins, plugin.name) == 1)
        << plugin.name;
  }
}

/// The same colour everywhere, but not of the same spectrum.
class Metamers final : public RgbTexture {
 public:
  Rgb evaluate(const TexturePoint&) const override { return Rgb(0.5f); }
  std::optional<Rgb> constant() const override { return Rgb(0.5f); }
};
class Ramp final : public FloatTexture {
 public:
  float evaluate(const TexturePoint& at) const override { return at.uv.x; }
};

std::unique_ptr<Material> with_texture(std::string_view type, const char* param, const char* texture,
                                       const TextureSet& textures) {
  Diagnostics diagnostics;
  const ParamList list{{texture_param(param, texture)}};
  ParamReader reader(list, "material", {}, diagnostics);
  auto material = material_plugins().find(type)->make(reader, MaterialContext{textures});
  EXPECT_TRUE(diagnostics.all().empty());
  return material;
}

TEST(PlainMaterial, OfPlainTexturesInRgb) {
  Workshop w;
  const auto brighter_than_white = w.make<Rgb>(  // so it is clamped
      "fbm", {integer_param("octaves", 3), number_param("roughness", 3)});
  w.textures.add<Rgb>("clouds", brighter_than_white);
  w.textures.add<Rgb>("tiles", w.make<Rgb>("checkerboard", {number_param("uscale", 7), number_param("vscale", 5),
                                                            triple_param(ParamType::rgb, "tex1", .9f, .3f, .6f),
                                                            texture_param("tex2", "clouds")}));
  w.textures.add<float>("grain", w.make<float>("wrinkled", {}));
  const auto expect_plain_in_rgb = [&](const char* type, const char* param, const char* texture) {
    const auto material = with_texture(type, param, texture, w.textures);
    expect_same_answers(*material, Palette::rgb(), std::string(type) + " of " + texture + " for " + param);
    EXPECT_FALSE(material->plain(*Palette::of_iteration(3, 5))) << type;
  };
  for (const char* texture : {"clouds", "tiles"}) {
    expect_plain_in_rgb("diffuse", "reflectance", texture);
    expect_plain_in_rgb("thindielectric", "tint", texture);
    expect_plain_in_rgb("coateddiffuse", "reflectance", texture);
    expect_plain_in_rgb("coatedconductor", "reflectance", texture);
    for (const char* param : {"reflectance", "transmittance"})
      expect_plain_in_rgb("diffusetransmission", param, texture);
    for (const char* param : {"reflectance", "eta", "k"}) expect_plain_in_rgb("conductor", param, texture);
  }
  for (const char* type : {"conductor", "dielectric", "coateddiffuse"})
    for (const char* param : {"roughness", "uroughness", "vroughness"}) expect_plain_in_rgb(type, param, "grain");
  for (const char* param : {"interface.roughness", "conductor.roughness"})
    expect_plain_in_rgb("coatedconductor", param, "grain");
  expect_same_answers(MixMaterial({part("diffuse"), part("conductor")}, w.textures.find<float>("grain")),
                      Palette::rgb(), "mix by a texture");
}

TEST(PlainMaterial, NotOfTexturesThatVary) {
  TextureSet textures;
  textures.add<Rgb>("metamers", std::make_shared<Metamers>());
  textures.add<float>("ramp", std::make_shared<Ramp>());
  textures.add<float>("half", std::make_shared<ConstantTexture<float>>(0.5f));
  const auto plain_with = [&](std::string_view type, const char* param, const char* texture) {
    return plain_of(*with_texture(type, param, texture, textures));
  };
  EXPECT_FALSE(plain_with("diffuse", "reflectance", "metamers"));
  EXPECT_FALSE(plain_with("thindielectric", "tint", "metamers"));
  EXPECT_FALSE(plain_with("coateddiffuse", "reflectance", "metamers"));
  for (const char* param : {"eta", "k", "reflectance"}) EXPECT_FALSE(plain_with("conductor", param, "metamers"));
  EXPECT_FALSE(plain_with("coatedconductor", "reflectance", "metamers"));
  for (const char* param : {"interface.roughness", "conductor.vroughness"})
    EXPECT_FALSE(plain_with("coatedconductor", param, "ramp")) << param;
  for (const char* param : {"reflectance", "transmittance"})
    EXPECT_FALSE(plain_with("diffusetransmission", param, "metamers")) << param;
  EXPECT_FALSE(plain_of(MixMaterial({part("diffuse"), part("conductor")}, std::make_shared<Ramp>())));
  for (const char* type : {"conductor", "dielectric", "coateddiffuse"}) {
    for (const char* param : {"roughness", "uroughness", "vroughness"})
      EXPECT_FALSE(plain_with(type, param, "ramp")) << type << " " << param;
    EXPECT_TRUE(plain_with(type, "roughness", "half")) << type;
  }
}

TEST(PlainMaterial, OfABodyInAnother) {
  const RefractiveIndex water = RefractiveIndex::of_abbe(1.35f, 30);
  for (const std::vector<Param>& params : {std::vector<Param>{},
                                           {number("roughness", 0.3f)},
                                           {number("uroughness", 0.3f), number("vroughness", 0.1f)},
                                           {text("glass", "SF11")},
                                           {number("eta", 1.35f), number("roughness", 0.3f)}})
    for (const PlainIndex& outside : {PlainIndex{1.35f}, water.plain()}) {
      const auto glass = make("dielectric", params);
      glass->set_priority(2);
      expect_same_answers(*glass, Palette::rgb(), "glass in water", outside);
      expect_same_answers(*glass, *Palette::of_iteration(3, 5), "glass in water", outside);
    }
}

TEST(PlainMaterial, NotOfBodiesThatScatter) {
  EXPECT_TRUE(plain_of(*make("dielectric", {rgb("attenuationcolor", {1, 0.9f, 1})})));
  EXPECT_FALSE(plain_of(*make("subsurface", {})));
}

class Upright final : public Relief {
 public:
  Vec3 normal(const SurfacePoint&, const PlacedShape&, int, Vec2) const override { return {0, 0, 1}; }
};

TEST(PlainMaterial, NotWithRelief) {
  for (const std::string_view type : kPlainPlugins) {
    const auto bumpy = make(type, {});
    bumpy->set_relief(std::make_shared<Upright>());
    EXPECT_FALSE(plain_of(*bumpy)) << type;
  }
}

}  // namespace
}  // namespace dspm::test
