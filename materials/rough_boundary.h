// A rough boundary between two media: which facet sends light from one direction to another, by reflection or by
// refraction. Directions are in the shading frame with wo above (z > 0); `eta` is the index of refraction beyond the
// boundary over that on wo's side. [Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces]
#pragma once

#include <cmath>
#include <optional>

#include "dspm/base/math/vec.h"
#include "dspm/materials/bsdf.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/microfacet.h"

namespace dspm {

/// Returns the factor by which transmitted light changes: beyond the interface, radiance is spread over a larger or
/// smaller cone; flux is not. [Veach 1997, 5.2]
constexpr float transport_scale(Transport transport, float eta) {
  return transport == Transport::radiance ? 1 / (eta * eta) : 1;
}

/// The solid angle of a facet's normal m over that of wi, for light that it refracts.
constexpr float solid_angle_ratio(const Vec3& wo, const Vec3& wi, const Vec3& m, float eta) {
  const float root = dot(wi, m) + dot(wo, m) / eta;
  return std::abs(dot(wi, m)) / (root * root);
}

struct Facet {
  Vec3 m;
  float fresnel;
  float solid_angle_ratio;  // for transmission
};

/// Returns the facet that sends light from wo to wi; nullopt if there is none.
constexpr std::optional<Facet> facet_between(const Vec3& wo, const Vec3& wi, float eta) {
  const bool reflected = wi.z > 0;
  Vec3 m = normalize(reflected ? wo + wi : wo + wi * eta);
  if (m.z < 0) m = -m;
  // A facet's front sees wo; its back, where light passes, sees wi.
  if (dot(m, wo) <= 0 || dot(m, wi) * wi.z <= 0) return std::nullopt;
  return Facet{m, fresnel_dielectric(dot(wo, m), eta), reflected ? 0.f : solid_angle_ratio(wo, wi, m, eta)};
}

/// f of refraction for flux, if the facets let all light through. [Walter et al. 2007, (21)], divided by eta^2 above
/// and below the line.
constexpr float refraction(const Ggx& facets, const Vec3& wo, const Vec3& wi, const Facet& facet) {
  return facets.density(facet.m) * facets.visible(wo, wi) * dot(wo, facet.m) * facet.solid_angle_ratio / (wo.z * -wi.z);
}
/// The density by solid angle of the direction to which a facet from sample_visible() refracts wo.
constexpr float refraction_density(const Ggx& facets, const Vec3& wo, const Facet& facet) {
  return facets.visible_density(wo, facet.m) * facet.solid_angle_ratio;
}

}  // namespace dspm
