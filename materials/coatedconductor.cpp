// coatedconductor: metal under a clear coat, such as lacquered brass or metallic paint.
//
//   Material "coatedconductor" "float conductor.roughness" 0.1 "float interface.roughness" 0.001
//
//   interface.eta           float or spectrum   1.5         index of refraction of the coat over outside
//   interface.roughness     float texture       0           of the coat's surface; also .uroughness and .vroughness
//   conductor.eta, .k       spectrum texture    metal-Cu-*  complex index of refraction of the metal
//   reflectance             spectrum texture    none        of the metal at normal incidence, instead of both
//   conductor.roughness     float texture       0           of the metal; also .uroughness and .vroughness
//   remaproughness          bool                true        alpha is sqrt(roughness), else roughness itself
//   energycompensation      bool                true        false in .pbrt files: see below
//   g, albedo                                   0           of a medium in the coat; only 0 is supported
//   thickness, maxdepth, nsamples               0.01, 10, 1 of pbrt's random walk: thickness absorbs
//
// Both sides are coated. The coat mirrors (smooth, or GGX), and refracts as if it were smooth. With o' and i' the
// directions in the coat and R the metal's reflectance for light in the coat,
//   f = F-mirror or GGX + g GGX(o', i') R / eta^2,   g = (1 - F(o)) (1 - F(i)) / (1 - R sqrt(F(o) F(i))),
// where g counts what goes to and fro on the mirror's way, and is at most 1 - F(o) and 1 - F(i). What white metal would
// lose (light that is totally reflected in the coat, or meets a second facet) leaves as a diffuse lobe, coloured by two
// or more reflections. A rough coat widens the metal's lobe: to first order, a facet of slope s turns refracted light
// by (1 - 1/eta) s and mirrored light by 2 s. White metal gives back all light. Without energycompensation
// there is no diffuse lobe, and exp(-thickness / cos) is lost on each way through the coat, as in pbrt's walk. That
// keeps a little of what is totally reflected, and loses what is left at maxdepth, which is small.
// [Kulla and Conty 2017; Belcour 2018, Efficient Rendering of Layered Materials]
#include <memory>
#include <optional>

#include "dspm/base/colour/palette.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/albedo_table.h"
#include "dspm/materials/coat.h"
#include "dspm/materials/coated_conductor_bsdf.h"
#include "dspm/materials/facet_albedo.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/made_once.h"
#include "dspm/materials/material.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_material.h"

namespace dspm {
namespace {

std::shared_ptr<const AlbedoTable> metal_under_coat(float eta) {
  static MadeOnce<AlbedoTable> tables;
  return tables.of(eta, [](float index) {
    const CoatOverMetal smooth{.coat = {index}};
    return AlbedoTable([&](float cos, float alpha) {
      const auto o = smooth.inside(direction_of_cosine(cos));
      if (!o) return 0.f;
      const Ggx facets({alpha, alpha});
      return mean_over_facets(facets, *o, [&](const Vec3& m) {
        const Vec3 i = reflect(*o, m);
        const auto out = smooth.outside(i);
        if (!out) return 0.f;
        return CoatOverMetal::passed_twice(smooth.coat.mirrored(cos), smooth.coat.mirrored(out->z), 1) *
               facets.visible_after(*o, i);
      });
    });
  });
}

std::shared_ptr<const AlbedoTable> mirrored_by_rough_coat(float eta) {
  static MadeOnce<AlbedoTable> tables;
  return tables.of(eta, [](float index) {
    return AlbedoTable([&](float cos, float alpha) { return reflected_by_boundary(cos, alpha, index); });
  });
}

class CoatedConductorMaterial final : public Material {
 public:
  CoatedConductorMaterial(ParamReader& reader, const MaterialContext& context)
      : shared_{.coat = {read_eta(reader, 1.5f, "interface.eta")}},
        remap_(Roughness::read_remap(reader)),
        interface_(reader, context, "interface.", remap_),
        metal_roughness_(reader, context, "conductor.", remap_),
        metal_(reader, context, "conductor.") {
    shared_.makes_up = read_energy_compensation(reader, context);
    const RandomWalk walk = read_random_walk(reader, !shared_.makes_up);
    if (!shared_.makes_up) shared_.coat.thickness = walk.thickness;
  }
  /// Call this after the parameters have been checked.
  void make_tables() {
    by_way_ = metal_under_coat(shared_.coat.eta), rough_coat_ = mirrored_by_rough_coat(shared_.coat.eta);
    shared_.by_way = by_way_.get(), shared_.rough_coat = rough_coat_.get();
    shared_.mirrored_mean = mean_fresnel_outside(shared_.coat.eta);
  }

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return PlainCoatedConductor{interface_.here(point), metal_roughness_.here(point), metal_.here(point), shared_}
        .with_bsdf(point, IntoSlot{slot});
  }

 private:
  std::optional<PlainMaterial> plain_look(const Palette& palette) const override {
    const auto coat = interface_.plain(palette), metal_roughness = metal_roughness_.plain(palette);
    const auto metal = metal_.plain(palette);
    if (!coat || !metal_roughness || !metal) return std::nullopt;
    return PlainCoatedConductor{*coat, *metal_roughness, *metal, shared_};
  }

  CoatOverMetal shared_;
  std::shared_ptr<const AlbedoTable> by_way_, rough_coat_;  // those of shared_
  bool remap_;
  Roughness interface_, metal_roughness_;
  MetalLook metal_;
};

}  // namespace

std::unique_ptr<Material> make_coatedconductor(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<CoatedConductorMaterial>(reader, context);
  reader.finish();
  material->make_tables();
  return material;
}

}  // namespace dspm
