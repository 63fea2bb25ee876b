// A clear coat over a base: what it lets through, and the parameters of pbrt's random walk in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "dspm/materials/boundary_tables.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/microfacet.h"
#include "dspm/params/params.h"

namespace dspm {

/// What all points of a coat share. With `facets`, it loses light as pbrt's does.
struct Coat {
  float eta, thickness = 0;
  std::shared_ptr<const BoundaryTables> facets;

  float left(float cos) const { return std::exp(-thickness / std::max(cos, 1e-6f)); }

  /// The share of light from outside that reaches the base, or of diffuse light from the base that leaves this way.
  float let_through(float cos, bool smooth, const Ggx& rough) const {
    if (!facets) return 1 - fresnel_dielectric(cos, eta);
    const float sin2_inside = (1 - cos * cos) / (eta * eta);
    if (sin2_inside >= 1) return 0;
    const float passed = smooth ? 1 - fresnel_dielectric(cos, eta) : facets->outside.refracted(cos, mean_alpha(rough));
    return passed * left(std::sqrt(1 - sin2_inside));
  }
  /// What is below gets the light that a smooth coat transmits. For indices of 1 to 4, facets mirror hardly more than the
  /// remainder, 0.3% at most. Outside that range, total reflection or Brewster's angle near grazing make it up to 26%:
  /// there a facet mirrors no more than the smooth coat does for either direction.
  float mirrored_by_facet(float cos, float cos_o, float cos_i) const {
    const float mirrored = fresnel_dielectric(cos, eta);
    if (eta >= 1 && eta <= 4) return mirrored;
    return std::min({mirrored, fresnel_dielectric(cos_o, eta), fresnel_dielectric(cos_i, eta)});
  }
  static float mean_alpha(const Ggx& rough) { return (rough.alpha().x + rough.alpha().y) / 2; }
};

/// The parameters of pbrt's random walk through the coat and its medium.
struct RandomWalk {
  float thickness;
  int visits;  // of the base, at most
};
/// Without `as_in_pbrt`, a warning says that thickness, maxdepth and nsamples have no effect.
RandomWalk read_random_walk(ParamReader& reader, bool as_in_pbrt);

}  // namespace dspm
