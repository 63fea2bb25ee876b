// A clear coat over a base: what its surface mirrors and its thickness absorbs, and the parameters of pbrt's random walk in
// it.
#pragma once

#include <algorithm>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/microfacet.h"

namespace dspm {

/// A plain value, which a device can have.
struct Coat {
  float eta, thickness = 0;

  constexpr float left(float cos) const { return rounded::exp(-thickness / std::max(cos, 1e-6f)); }
  constexpr float mirrored(float cos) const { return fresnel_dielectric(cos, eta); }
  /// Returns whether facets mirror hardly more than a smooth coat, at most 0.3%. For other indices, total reflection or
  /// Brewster's angle near grazing make it up to 26%: there a facet mirrors no more than the smooth coat does for
  /// either direction.
  constexpr bool is_usual() const { return eta >= 1 && eta <= 4; }
  constexpr float mirrored_by_facet(float cos, float cos_o, float cos_i) const {
    return is_usual() ? mirrored(cos) : std::min(std::min(mirrored(cos), mirrored(cos_o)), mirrored(cos_i));
  }
  static constexpr float mean_alpha(const Ggx& rough) { return (rough.alpha().x + rough.alpha().y) / 2; }
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
