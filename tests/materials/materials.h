// What the tests of materials share: materials as a scene would ask for them, surfaces to put them on, directions.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/rng.h"
#include "materials/material.h"
#include "textures/texture_set.h"

namespace dspm::test {

inline Param number(std::string name, float value) {
  return {ParamType::number, std::move(name), 0, std::vector<float>{value}, {}, {}};
}
inline Param rgb(std::string name, Rgb c) {
  return {ParamType::rgb, std::move(name), 0, std::vector<float>{c.r, c.g, c.b}, {}, {}};
}
inline Param flag(std::string name, bool value) {
  return {ParamType::boolean, std::move(name), 0, std::vector<bool>{value}, {}, {}};
}
inline Param alpha(float value) { return number("roughness", value * value); }  // remapped: alpha = sqrt(roughness)

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

/// A surface whose normals are z, unless shading bends them.
inline SurfacePoint surface(Vec3 ns = {0, 0, 1}, Vec3 dpdu = {1, 0, 0}) {
  return {{}, {}, {0, 0, 1}, normalize(ns), dpdu, {0.3f, 0.6f}};
}
inline SurfacePoint bent_surface() { return surface({0.35f, -0.2f, 1}, {2, 1, 0}); }

inline Vec3 direction(float cos, float phi) {
  const float sin = std::sqrt(std::max(0.f, 1 - cos * cos));
  return {sin * std::cos(phi), sin * std::sin(phi), cos};
}
/// From straight on to grazing.
inline std::vector<Vec3> directions_above() {
  return {direction(1, 0), direction(0.9f, 1), direction(0.6f, 2.5f), direction(0.3f, 4), direction(0.03f, 5.5f)};
}
inline std::vector<Vec3> directions() {
  std::vector<Vec3> both = directions_above();
  for (const Vec3& w : directions_above()) both.push_back({w.x, w.y, -w.z});
  return both;
}

inline Vec3 three_numbers(const PathRandom& random, int n) {
  const Vec2 pair = random.pair(n, 0);
  return {pair.x, pair.y, random.number(n, 2)};
}
/// Uniform over the sphere.
inline Vec3 any_direction(const PathRandom& random, int n) {
  const Vec2 u = random.pair(n, 4);
  return direction(2 * u.x - 1, 2 * kPi * u.y);
}

/// Has no lobe that evaluate knows of.
inline bool is_specular(const Bsdf& bsdf) { return bsdf.lobes(1e-6f) == 0; }

struct Named {
  std::string name;
  std::unique_ptr<Material> material;
};
/// Every material, smooth and rough.
inline std::vector<Named> all_materials() {
  std::vector<Named> all;
  all.push_back({"diffuse", make("diffuse", {rgb("reflectance", {0.2f, 0.5f, 0.8f})})});
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
  all.push_back({"dense glass", make("dielectric", {number("eta", 2.4f), alpha(0.4f)})});
  all.push_back({"bubble in water", make("dielectric", {number("eta", 0.75f), alpha(0.4f)})});
  return all;
}

}  // namespace dspm::test
