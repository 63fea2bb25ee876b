// coateddiffuse: a diffuse base under a clear coat, such as plastic, varnished wood or glazed clay.
//
//   Material "coateddiffuse" "rgb reflectance" [.6 .1 .1] "float roughness" 0.1
//
//   reflectance       spectrum texture    0.5         of the base
//   eta               float or spectrum   1.5         index of refraction of the coat over outside
//   roughness         float texture       0           of the coat's surface, in both directions
//   uroughness        float texture       roughness   along the first tangent
//   vroughness        float texture       roughness   across it
//   remaproughness    bool                true        alpha is sqrt(roughness), else roughness itself
//   energycompensation   bool             true        false in .pbrt files: see below
//   g, albedo                             0           of a medium in the coat; only 0 is supported
//   thickness, maxdepth, nsamples         0.01, 10, 1 of pbrt's random walk, see below
//
// Both sides are coated. The coat mirrors (smooth, or GGX). The light that it transmits is scattered by the base,
// partly reflected back by the coat from inside, scattered again, and so on: a geometric series, with a = reflectance,
//   f = F-mirror or GGX + (1 - F(wo)) (1 - F(wi)) / eta^2 * a / (pi (1 - a F_in)),
// where F_in is the mean Fresnel reflectance for diffuse light from inside. A rough coat lets in what its facets do not
// mirror: F is their albedo then (made_up.h). So a coat over a white base loses nothing. For indices outside 1 to 4,
// light enters a rough coat as if it were smooth, and the facets' Fresnel term is bounded by the smooth coat's.
//
// Without energycompensation, the coat loses what pbrt's random walk loses: exp(-thickness / cos) on each way through
// it, what is left after maxdepth / 2 (rounded up) visits of the base, and light that meets two facets of a rough coat.
// As the base is diffuse, the walk's mean is a series as well,
//   f = F-mirror or GGX + t(wo) t(wi) / eta^2 * a / pi * sum over k of (a G)^k,
// with t the albedo of refraction by the facets times exp(-thickness / cos inside), and G that of their reflection of
// diffuse light from inside, there and back through the coat. nsamples has no effect: there is no noise.
// [Wolff 1994, Diffuse-Reflectance Model for Smooth Dielectric Surfaces; Pharr, Jakob and Humphreys 2023, Physically
// Based Rendering, 14.3]
#include <memory>
#include <optional>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/boundary_tables.h"
#include "dspm/materials/brushed_tables.h"
#include "dspm/materials/coat.h"
#include "dspm/materials/coated_diffuse_bsdf.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_material.h"
#include "dspm/textures/plain_part.h"

namespace dspm {
namespace {

class CoatedDiffuseMaterial final : public Material {
 public:
  CoatedDiffuseMaterial(ParamReader& reader, const MaterialContext& context)
      : base_{.way = {.coat = {read_eta(reader)}}},
        roughness_(reader, context),
        makes_up_(read_energy_compensation(reader, context)) {
    base_.let_in = 1 - mean_fresnel_outside(eta());
    const auto reflectance = reader.rgb_or_texture("reflectance", Rgb(0.5f), SpectrumRole::albedo, "of the base");
    reflectance_ = texture_of(reflectance, context.textures, reader.diagnostics());
    plain_reflectance_.emplace(reflectance_);
    walk_ = read_random_walk(reader, !makes_up_);
  }

  /// Call this after the parameters have been checked.
  void make_tables() {
    if (!makes_up_) return lose_as_in_pbrt();
    if (roughness_.is_smooth() || !base_.way.coat.is_usual()) return;
    keep(boundary_tables(eta()));
    if (roughness_.is_even()) return;
    brushed_ = brushed_dielectric(eta());
    base_.way.brushed = brushed_.get();
  }

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return PlainCoatedDiffuse{roughness_.here(point), {reflectance_->carried(texture_point(point))}, base_}.with_bsdf(
        point, IntoSlot{slot});
  }

 private:
  std::optional<PlainMaterial> plain_look(const Palette& palette) const override {
    const auto roughness = roughness_.plain(palette);
    const auto reflectance = plain_reflectance_->value(palette);
    return roughness && reflectance ? std::optional<PlainMaterial>(PlainCoatedDiffuse{*roughness, *reflectance, base_})
                                    : std::nullopt;
  }

  float eta() const { return base_.way.coat.eta; }
  void keep(std::shared_ptr<const BoundaryTables> facets) {
    facets_ = std::move(facets);
    base_.way.facets = facets_.get();
  }

  void lose_as_in_pbrt() {
    Coat& coat = base_.way.coat;
    base_.way.loses = true, coat.thickness = walk_.thickness, base_.visits = walk_.visits;
    keep(boundary_tables(coat.eta));
    constexpr int kSteps = 1024;
    float without = 0;
    for (int i = 0; i < kSteps; ++i) {
      const float cos = (static_cast<float>(i) + 0.5f) / kSteps;
      const float mirrored = 2 * cos * fresnel_dielectric(cos, 1 / coat.eta) / kSteps;
      without += mirrored, base_.mirrored_inside += mirrored * coat.left(cos) * coat.left(cos);
    }
    base_.left_inside = without > 0 ? base_.mirrored_inside / without : 1;
  }

  CoatedBase base_;
  std::shared_ptr<const BoundaryTables> facets_;  // those of base_
  std::shared_ptr<const BrushedAlbedo> brushed_;
  Roughness roughness_;
  bool makes_up_;
  TexturePtr<Rgb> reflectance_;
  std::optional<PlainPart<Rgb>> plain_reflectance_;
  RandomWalk walk_{};
};

}  // namespace

std::unique_ptr<Material> make_coateddiffuse(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<CoatedDiffuseMaterial>(reader, context);
  reader.finish();
  material->make_tables();
  return material;
}

}  // namespace dspm
