// Parameters that several materials share.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/material.h"
#include "dspm/materials/microfacet.h"
#include "dspm/textures/texture_set.h"

namespace dspm {

template <class T>
class PlainPart;
struct PlainMetal;
struct PlainRoughness;

/// The place at which textures are looked up; place_of() is that of plain textures.
inline TexturePoint texture_point(const SurfacePoint& point) {
  return {point.p, point.uv, point.ng, point.dpdu, point.dpdv, point.dpdx, point.dpdy, point.vertices, point.palette};
}

/// Reads "roughness", "uroughness", "vroughness" and "remaproughness" as GGX alpha along the tangent and across it.
class Roughness {
 public:
  Roughness(ParamReader& reader, const MaterialContext& context) : Roughness(reader, context, "") {
    remap_ = read_remap(reader);
  }
  /// Reads "interface.roughness" and so on if `prefix` is "interface."; without `remap` there is no "remaproughness".
  Roughness(ParamReader& reader, const MaterialContext& context, const std::string& prefix, bool remap = true);
  static bool read_remap(ParamReader& reader);
  Vec2 alpha(const SurfacePoint& point) const;
  /// Returns what it is at the point.
  PlainRoughness here(const SurfacePoint& point) const;
  /// Returns what it is at all points, for paths of that palette, if that has a plain form. This must outlive it.
  std::optional<PlainRoughness> plain(const Palette& palette) const;
  /// These return whether the surface is smooth, or equally rough in both directions, at every point.
  bool is_smooth() const { return u_->constant() == 0.f && v_->constant() == 0.f; }
  bool is_even() const { return u_ == v_ || (u_->constant() && u_->constant() == v_->constant()); }

 private:
  TexturePtr<float> u_, v_;
  std::shared_ptr<const PlainPart<float>> plain_u_, plain_v_;
  bool remap_;
};

/// Reads "energycompensation": whether what rough facets lose is made up for (made_up.h). By default a .pbrt file does
/// not make up for it.
bool read_energy_compensation(ParamReader& reader, const MaterialContext& context);

/// Reads an index of refraction of what does not refract light by its wavelength: a spectrum is averaged, with a note.
float read_eta(ParamReader& reader, float fallback = 1.5f, const std::string& name = "eta");

/// Reads "eta" and "k", both after `prefix`, or "reflectance" at normal incidence.
class MetalLook {
 public:
  MetalLook(ParamReader& reader, const MaterialContext& context, const std::string& prefix = "");
  MetalIndex index(const SurfacePoint& point) const;
  /// As those of Roughness.
  PlainMetal here(const SurfacePoint& point) const;
  std::optional<PlainMetal> plain(const Palette& palette) const;

 private:
  bool by_reflectance_;
  TexturePtr<Rgb> eta_or_reflectance_, k_;
  std::shared_ptr<const PlainPart<Rgb>> plain_eta_or_reflectance_, plain_k_;
};

/// Returns whether a material of that type has "alpha", "emission" and "emissionstrength". These scatter nothing: world
/// makes holes of the first and area lights of the others.
inline bool has_holes_and_light(std::string_view material) { return material == "principled"; }

/// 1 where the surface is, 0 where it has a hole.
ValueOrTexture<float> read_opacity(ParamReader& reader);

/// The radiance that leaves both sides of a surface.
struct EmissionLook {
  ValueOrTexture<Rgb> colour;
  float strength = 1;
};
EmissionLook read_emission_look(ParamReader& reader);

/// What a body absorbs: white light has a colour after a distance through it, in world units.
class Absorption {
 public:
  Absorption() = default;
  /// Reads "attenuationcolor" and "attenuationdistance", as in glTF's KHR_materials_volume.
  explicit Absorption(ParamReader& reader);

  bool is_none() const { return is_black(in_rgb_); }
  /// Material::absorption().
  Spectrum per_length(const Palette& palette) const {
    return palette.is_rgb() ? in_rgb_ : of(palette.carried(colour_));
  }

 private:
  Spectrum of(const Spectrum& left) const;

  Colour colour_{Rgb(1)};
  float distance_ = 1;
  Spectrum in_rgb_;
};

/// Reads "priority" of any material, for any plugin, as Material::priority(), if it is given. Call it before the
/// material's own factory reads the rest.
std::optional<int> read_priority(ParamReader& reader);

}  // namespace dspm
