// conductor: metal, smooth or rough.
//
//   Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k" "float roughness" 0.1
//
//   eta, k           spectrum texture   metal-Cu-eta, metal-Cu-k   complex index of refraction eta + ik
//   reflectance      spectrum texture   none                       at normal incidence, instead of eta and k
//   roughness        float texture      0                          of both directions
//   uroughness       float texture      roughness                  along the first tangent
//   vroughness       float texture      roughness                  across it
//   remaproughness   bool               true                       alpha is sqrt(roughness), else roughness itself
//   energycompensation   bool           true                       false in .pbrt files: see below
//
// Both sides reflect. Rough metal is GGX with Smith's height-correlated shadowing, and a diffuse lobe for light that
// meets a second facet (made_up.h), coloured by two or more reflections; without energycompensation that light is lost,
// as in pbrt (tests/materials/energy_test.cpp states how much). A reflectance r stands for eta = 1,
// k = 2 sqrt(r / (1 - r)).
// [Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces; Heitz 2014; Kulla and Conty 2017]
#include <optional>

#include "dspm/base/colour/palette.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/conductor_bsdf.h"
#include "dspm/materials/material.h"
#include "dspm/materials/metal_tables.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_material.h"

namespace dspm {
namespace {

class ConductorMaterial final : public Material {
 public:
  ConductorMaterial(ParamReader& reader, const MaterialContext& context)
      : roughness_(reader, context), metal_(reader, context), makes_up_(read_energy_compensation(reader, context)) {}

  /// Call this after the parameters have been checked.
  void make_tables() {
    if (!makes_up_ || roughness_.is_smooth()) return;
    tables_.even = &even_metal();
    if (!roughness_.is_even()) tables_.brushed = &brushed_metal();
  }

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return PlainConductor{roughness_.here(point), metal_.here(point), tables_}.with_bsdf(point, IntoSlot{slot});
  }

 private:
  std::optional<PlainMaterial> plain_look(const Palette& palette) const override {
    const auto roughness = roughness_.plain(palette);
    const auto metal = metal_.plain(palette);
    return roughness && metal ? std::optional<PlainMaterial>(PlainConductor{*roughness, *metal, tables_})
                              : std::nullopt;
  }

  Roughness roughness_;
  MetalLook metal_;
  bool makes_up_;
  MetalTables tables_;  // empty if nothing is made up for
};

}  // namespace

std::unique_ptr<Material> make_conductor(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<ConductorMaterial>(reader, context);
  reader.finish();
  material->make_tables();
  return material;
}

}  // namespace dspm
