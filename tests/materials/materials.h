// What the tests of materials share: materials as a scene would ask for them.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "dspm/materials/material.h"
#include "dspm/testing/scattering_cases.h"
#include "dspm/textures/texture_set.h"

namespace dspm::test {

inline Param number(std::string name, float value) {
  return {ParamType::number, std::move(name), {}, std::vector<float>{value}, {}, {}};
}
/// `c` is an Rgb, or what a path carries of one in a render in RGB.
template <class C = Rgb>
Param rgb(std::string name, const C& c) {
  return {ParamType::rgb, std::move(name), {}, std::vector<float>{c[0], c[1], c[2]}, {}, {}};
}
inline Param text(std::string name, std::string value) {
  return {ParamType::text, std::move(name), {}, std::vector<std::string>{std::move(value)}, {}, {}};
}
inline Param flag(std::string name, bool value) {
  return {ParamType::boolean, std::move(name), {}, std::vector<bool>{value}, {}, {}};
}
inline Param alpha(float value) { return number("roughness", value * value); }  // remapped: alpha = sqrt(roughness)

inline const Param kLossy = flag("energycompensation", false);

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The material that a scene with these parameters gets; `diagnostics` holds what is said about them.
inline std::unique_ptr<Material> make(std::string_view type, std::vector<Param> params, Diagnostics& diagnostics) {
  const TextureSet textures;
  const Plugin<MakeMaterial>* plugin = material_plugins().find(type, {}, diagnostics);
  if (!plugin) return nullptr;
  const ParamList list{std::move(params)};
  ParamReader reader(list, "material \"" + std::string(type) + "\"", {}, diagnostics);
  return plugin->make(reader, MaterialContext{textures});
}
inline std::unique_ptr<Material> make(std::string_view type, std::vector<Param> params) {
  Diagnostics diagnostics;
  std::unique_ptr<Material> material = make(type, std::move(params), diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << to_string(diagnostics.all().front());
  return material;
}

/// Has no lobe that evaluate knows of.
inline bool is_specular(const Bsdf& bsdf) { return bsdf.lobes(1e-6f) == 0; }

struct Named {
  std::string name;
  std::unique_ptr<Material> material;
};
/// The principled material as this and that.
inline std::vector<Named> principled_materials() {
  const Param base = rgb("basecolor", {0.2f, 0.5f, 0.8f});
  const auto of = [&](const char* name, std::vector<Param> params) {
    params.push_back(base);
    return Named{std::string("principled ") + name, make("principled", std::move(params))};
  };
  std::vector<Named> all;
  all.push_back(of("plastic", {number("roughness", 0.4f)}));
  all.push_back(of("smooth plastic", {number("roughness", 0)}));
  all.push_back(of("metal", {number("metallic", 1), number("roughness", 0.6f), number("anisotropy", 0.8f)}));
  all.push_back(of("smooth metal", {number("metallic", 1), number("roughness", 0)}));
  all.push_back(of("smooth glass", {number("transmission", 1), number("roughness", 0)}));
  all.push_back(of("rough glass", {number("transmission", 1), number("roughness", 0.6f)}));
  all.push_back(of("varnish", {number("coat", 1), number("coatroughness", 0.4f), number("roughness", 0.7f)}));
  all.push_back(of("smooth varnish", {number("coat", 0.7f), number("roughness", 0.5f), number("metallic", 0.5f)}));
  all.push_back(of("cloth", {rgb("sheen", {0.3f, 0.5f, 0.9f}), number("sheenroughness", 0.4f)}));
  all.push_back(of("thin glass", {number("transmission", 1), number("roughness", 0), flag("thin", true)}));
  all.push_back(of("thin frosted glass", {number("transmission", 1), number("roughness", 0.6f), flag("thin", true),
                                          number("coat", 0.5f), number("coatroughness", 0.4f)}));
  all.push_back(of("leaf", {number("diffusetransmission", 0.4f), rgb("diffusetransmissioncolor", {0.3f, 0.6f, 0.1f}),
                            number("roughness", 0.4f), rgb("specularcolor", {0.9f, 0.3f, 0})}));
  all.push_back(of("brushed at an angle", {number("metallic", 1), number("roughness", 0.6f), number("anisotropy", 0.8f),
                                           number("anisotropyrotation", 30)}));
  all.push_back(of("anodised metal", {number("metallic", 1), number("roughness", 0.5f), number("iridescence", 1),
                                      number("iridescenceeta", 1.9f), number("iridescencethickness", 230)}));
  all.push_back(of("soap bubble", {number("transmission", 1), number("roughness", 0), flag("thin", true),
                                   number("iridescence", 1), number("iridescencethickness", 350)}));
  all.push_back(of("coated lens", {number("transmission", 1), number("roughness", 0.4f), number("iridescence", 0.8f),
                                   number("iridescenceeta", 1.7f), number("iridescencethickness", 150)}));
  all.push_back(of("beetle", {number("roughness", 0.5f), number("iridescence", 1), number("iridescenceeta", 2),
                              number("iridescencethickness", 300), number("coat", 0.5f)}));
  all.push_back(of("everything", {number("metallic", 0.3f), number("transmission", 0.4f), number("roughness", 0.5f),
                                  number("coat", 0.6f), number("coatroughness", 0.3f), rgb("sheen", Rgb(0.3f)),
                                  number("specular", 0.7f), number("eta", 1.7f), number("diffusetransmission", 0.3f)}));
  return all;
}

/// Every material, smooth and rough.
inline std::vector<Named> all_materials() {
  std::vector<Named> all;
  all.push_back({"diffuse", make("diffuse", {rgb("reflectance", {0.2f, 0.5f, 0.8f})})});
  for (const Spectrum& through : {Spectrum(0.4f, 0.3f, 0), Spectrum(0)})
    all.push_back({"diffuse transmission", make("diffusetransmission", {rgb("reflectance", {0.5f, 0.2f, 0.3f}),
                                                                        rgb("transmittance", through)})});
  all.push_back({"smooth conductor", make("conductor", {})});
  all.push_back({"smooth dielectric", make("dielectric", {})});
  all.push_back({"thin dielectric", make("thindielectric", {})});
  all.push_back({"smooth coat", make("coateddiffuse", {rgb("reflectance", {0.2f, 0.5f, 0.8f})})});
  all.push_back({"smooth coat, dark base", make("coateddiffuse", {rgb("reflectance", {0.02f, 0.05f, 0})})});
  all.push_back({"rough coat, dark base", make("coateddiffuse", {rgb("reflectance", {0.02f, 0.05f, 0}), alpha(0.3f)})});
  const auto add_rough = [&](const std::string& suffix, const std::vector<Param>& roughness) {
    for (const char* type : {"conductor", "dielectric", "coateddiffuse"})
      all.push_back({type + suffix, make(type, roughness)});
  };
  for (const float a : {0.05f, 0.1f, 0.3f, 1.f}) add_rough(" alpha " + std::to_string(a), {alpha(a)});
  add_rough(" anisotropic", {number("uroughness", 0.0225f), number("vroughness", 0.25f)});
  add_rough(" lossy", {alpha(0.4f), flag("energycompensation", false)});
  all.push_back({"dense glass", make("dielectric", {number("eta", 2.4f), alpha(0.4f)})});
  all.push_back({"bubble in water", make("dielectric", {number("eta", 0.75f), alpha(0.4f)})});
  const Param flint = text("glass", "F2");
  all.push_back({"flint glass", make("dielectric", {flint})});
  all.push_back({"rough flint glass", make("dielectric", {flint, alpha(0.4f)})});
  all.push_back(
      {"principled flint glass", make("principled", {flint, number("transmission", 1), number("roughness", 0)})});
  all.push_back({"principled rough flint glass",
                 make("principled", {flint, number("transmission", 0.7f), number("roughness", 0.5f),
                                     number("coat", 0.5f), number("diffusetransmission", 0.3f)})});
  const Param lacquer = number("interface.roughness", 0.01f), brushed = number("conductor.roughness", 0.1f);
  all.push_back({"coated mirror", make("coatedconductor", {})});
  all.push_back({"smooth coat over metal", make("coatedconductor", {brushed})});
  all.push_back({"rough coat over metal", make("coatedconductor", {lacquer, brushed})});
  all.push_back({"rough coat over a mirror", make("coatedconductor", {lacquer, number("interface.eta", 1.3f)})});
  for (Named& each : principled_materials()) all.push_back(std::move(each));
  return all;
}

}  // namespace dspm::test
