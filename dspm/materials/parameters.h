// Parameters that several materials share.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "dspm/colour/rgb.h"
#include "dspm/materials/material.h"
#include "dspm/materials/microfacet.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"
#include "dspm/textures/texture_set.h"

namespace dspm {

/// The place at which textures are looked up.
inline TexturePoint texture_point(const SurfacePoint& point) {
  return {point.p, point.uv, point.ng, point.dpdu, point.dpdv, point.dpdx, point.dpdy, point.vertices};
}

/// A texture may exceed what a surface can reflect.
inline Rgb clamped_albedo(const Rgb& c) {
  return {std::clamp(c.r, 0.f, 1.f), std::clamp(c.g, 0.f, 1.f), std::clamp(c.b, 0.f, 1.f)};
}

/// "roughness", "uroughness", "vroughness" and "remaproughness": GGX alpha along the tangent and across it.
class Roughness {
 public:
  Roughness(ParamReader& reader, const MaterialContext& context) : Roughness(reader, context, "") {
    remap_ = read_remap(reader);
  }
  /// "interface." as `prefix` reads "interface.roughness" and so on, but no "remaproughness".
  Roughness(ParamReader& reader, const MaterialContext& context, const std::string& prefix, bool remap = true);
  static bool read_remap(ParamReader& reader);
  Vec2 alpha(const SurfacePoint& point) const;
  /// Whether it is smooth, or equally rough in both directions, at every point.
  bool is_smooth() const { return u_->constant() == 0.f && v_->constant() == 0.f; }
  bool is_even() const { return u_ == v_ || (u_->constant() && u_->constant() == v_->constant()); }

 private:
  TexturePtr<float> u_, v_;
  bool remap_;
};

/// "energycompensation": whether what rough facets lose is made up for (made_up.h). In a .pbrt file, only if it says so.
bool read_energy_compensation(ParamReader& reader, const MaterialContext& context);

/// An index of refraction. dspm does not render dispersion: a spectrum is averaged, with a note.
float read_eta(ParamReader& reader, float fallback = 1.5f, const std::string& name = "eta");

/// A metal's complex index of refraction, eta + ik.
struct MetalIndex {
  Rgb eta, k;
};

/// "eta" and "k", both after `prefix`, or "reflectance" at normal incidence.
class MetalLook {
 public:
  MetalLook(ParamReader& reader, const MaterialContext& context, const std::string& prefix = "");
  MetalIndex index(const SurfacePoint& point) const;

 private:
  bool by_reflectance_;
  TexturePtr<Rgb> eta_or_reflectance_, k_;
};

/// Whether a material of that type has "alpha", "emission" and "emissionstrength", which scatter nothing: world makes
/// holes of the first and area lights of the others.
inline bool has_holes_and_light(std::string_view material) { return material == "principled"; }

/// 1 where the surface is, 0 where it has a hole.
ValueOrTexture<float> read_opacity(ParamReader& reader);

/// The radiance that leaves both sides of a surface.
struct EmissionLook {
  ValueOrTexture<Rgb> colour;
  float strength = 1;
};
EmissionLook read_emission_look(ParamReader& reader);

/// "attenuationcolor" and "attenuationdistance", as in glTF's KHR_materials_volume: white light that has gone that far
/// through the body, in world units, has this colour. As Material::absorption().
Rgb read_absorption(ParamReader& reader);

/// "priority" of any material, whatever its plugin, if it is given: as Material::priority(). To be called before the
/// material's own factory reads the rest.
std::optional<int> read_priority(ParamReader& reader);

}  // namespace dspm
