// dielectric: glass, water; smooth or rough, with light passing into the body.
//
//   Material "dielectric" "float eta" 1.33
//
//   eta                   float or spectrum   1.5         index of refraction inside over outside
//   abbe                  float               0           its Abbe number: eta is the index at 587.6 nm; 0: no dispersion
//   glass                 string              none        instead of eta: "BK7", "SF11", "diamond", ...
//   roughness             float texture       0           of both directions
//   uroughness            float texture       roughness   along the first tangent
//   vroughness            float texture       roughness   across it
//   remaproughness        bool                true        alpha is sqrt(roughness), else roughness itself
//   energycompensation    bool                true        false in .pbrt files: see below
//   attenuationcolor      spectrum            1           of white light after attenuationdistance in the body
//   attenuationdistance   float               1           in world units
//
// Inside is the side away from the geometric normal. If the index differs with the wavelength, light is refracted by
// that of the iteration, and goes on with its hue (wavelength.h); what is mirrored outside keeps all colours. Rough glass is GGX, and on the side that light comes from, a diffuse lobe for light that meets a second
// facet (made_up.h); without energycompensation that light is lost, as in pbrt. Coloured glass absorbs within the body:
// after a distance d, attenuationcolor^(d / attenuationdistance) is left (Beer's law). The body ends at its mesh, which
// should be closed; what is opaque may lie in it. Where bodies overlap, the one of the higher "priority" is there, and
// eta is that over air; between bodies of equal priority it is as written, and the body that light entered last counts.
// [Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces; glTF 2.0, KHR_materials_volume]
#include <memory>
#include <optional>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/boundary_tables.h"
#include "dspm/materials/brushed_tables.h"
#include "dspm/materials/dielectric_bsdf.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/per_surroundings.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_material.h"
#include "dspm/materials/refractive_index.h"

namespace dspm {
namespace {

/// Keeps the tables alive.
struct KeptTables {
  std::shared_ptr<const BoundaryTables> even;
  std::shared_ptr<const BrushedGlass> brushed;

  GlassTables tables() const { return {even.get(), brushed.get()}; }
};

class DielectricMaterial final : public Material {
 public:
  DielectricMaterial(ParamReader& reader, const MaterialContext& context)
      : index_(read_refractive_index(reader)),
        roughness_(reader, context),
        makes_up_(read_energy_compensation(reader, context)),
        absorption_(reader) {}
  /// Call this after the parameters have been checked.
  void make_tables() {
    if (!makes_up_ || roughness_.is_smooth()) return;
    tables_.emplace([this](float outside) {
      const float eta = index_.mean() / outside;
      if (eta == 1) return KeptTables{};
      return KeptTables{boundary_tables(eta), roughness_.is_even() ? nullptr : brushed_glass(eta)};
    });
  }

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return RefractingGlass{roughness_.here(point), {index_, point}, tables_in(point.outside_eta)}.with_bsdf(
        point, IntoSlot{slot});
  }
  bool bounds_a_body() const override { return true; }
  float eta() const override { return index_.mean(); }
  float eta_at(const Wavelength& wavelength) const override { return index_.at(wavelength); }
  bool disperses() const override { return index_.disperses(); }
  Spectrum absorption(const Palette& palette) const override { return absorption_.per_length(palette); }

 private:
  GlassTables tables_in(float outside_eta) const { return tables_ ? tables_->of(outside_eta).tables() : GlassTables{}; }
  std::optional<PlainMaterial> plain_within(const Palette& palette, const PlainIndex& outside) const override {
    const auto roughness = roughness_.plain(palette);
    if (!roughness) return std::nullopt;
    return PlainDielectric{*roughness, index_.plain(), outside, tables_in(outside.mean)};
  }

  RefractiveIndex index_;
  Roughness roughness_;
  bool makes_up_;
  std::optional<PerSurroundings<KeptTables>> tables_;
  Absorption absorption_;
};

}  // namespace

std::unique_ptr<Material> make_dielectric(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<DielectricMaterial>(reader, context);
  reader.finish();
  material->make_tables();
  return material;
}

}  // namespace dspm
