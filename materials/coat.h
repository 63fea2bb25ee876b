// A clear coat over a base: what it lets through, and the parameters of pbrt's random walk in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/boundary_tables.h"
#include "dspm/materials/brushed_tables.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/made_up.h"
#include "dspm/materials/microfacet.h"

namespace dspm {

/// The properties that all points of a coat share.
struct Coat {
  float eta, thickness = 0;
  std::shared_ptr<const BoundaryTables> facets = nullptr;  // null: it lets light in as if it were smooth
  std::shared_ptr<const BrushedAlbedo> brushed = nullptr;  // of what it mirrors; null: equally rough in both directions
  bool loses = false;  // what meets two facets, and in its thickness, as pbrt's does

  float left(float cos) const { return rounded::exp(-thickness / std::max(cos, 1e-6f)); }

  /// Returns the share of light from outside that reaches the base, or of diffuse light from the base that leaves this
  /// way.
  float let_through(const Vec3& w, bool smooth, const Ggx& rough) const {
    if (!loses) return 1 - (smooth || !facets ? fresnel_dielectric(w.z, eta) : mirrored(rough).of(w));
    const float sin2_inside = (1 - w.z * w.z) / (eta * eta);
    if (sin2_inside >= 1) return 0;
    const float passed = smooth ? 1 - fresnel_dielectric(w.z, eta) : facets->outside.refracted(w.z, mean_alpha(rough));
    return passed * left(std::sqrt(1 - sin2_inside));
  }
  /// Returns the albedo of what its facets mirror.
  FacetAlbedo mirrored(const Ggx& rough) const { return {rough.alpha(), facets->outside.reflected, brushed.get()}; }
  /// Returns whether facets mirror hardly more than a smooth coat, at most 0.3%. For other indices, total reflection or
  /// Brewster's angle near grazing make it up to 26%: there a facet mirrors no more than the smooth coat does for
  /// either direction.
  bool is_usual() const { return eta >= 1 && eta <= 4; }
  float mirrored_by_facet(float cos, float cos_o, float cos_i) const {
    const float mirrored = fresnel_dielectric(cos, eta);
    if (is_usual()) return mirrored;
    return std::min({mirrored, fresnel_dielectric(cos_o, eta), fresnel_dielectric(cos_i, eta)});
  }
  static float mean_alpha(const Ggx& rough) { return (rough.alpha().x + rough.alpha().y) / 2; }
};

/// The parameters of pbrt's random walk through the coat and its medium.
struct RandomWalk {
  float thickness;
  int visits;  // of the base, at most
};
/// Reads the walk. If the coat does not lose light, a warning says that thickness, maxdepth and nsamples have no
/// effect.
RandomWalk read_random_walk(ParamReader& reader, bool loses);

}  // namespace dspm
