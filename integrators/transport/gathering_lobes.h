// Which lobes of a surface gather photons, and which extend the path. `AnyBsdf` is a Bsdf, or one of the plain ones that a
// device has (plain_bsdf.h).
#pragma once

#include <algorithm>
#include <optional>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/dimension.h"
#include "dspm/materials/bsdf.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

/// Smooth lobes extend the path; rough ones gather or store photons. If a surface has both, the path chooses.
struct LobeChoice {
  LobeSet lobes;
  float chance;  // probability of this choice
  bool rough;
};

// Rougher lobes are not specular: Ggx::kSmoothest exceeds this.
inline constexpr float kLeastRoughness = 1e-4f;

/// The alpha above which a glossy lobe beside rough ones gathers with them: from there on, they sample its directions
/// about as densely as it does. On its own it would be chosen seldom, and count for much each time. Its density is at
/// most 1 / (4 pi alpha^2), theirs 1 / pi; the chances are those head-on, as paths from both ends have to agree.
template <class AnyBsdf>
constexpr float least_alpha_beside(LobeSet rough, const AnyBsdf& bsdf, const SurfaceGeometry& point) {
  const float chance = bsdf.lobe_probability(point.ns, rough);
  return 0.5f * rounded::sqrt(std::max(0.f, 1 - chance) / chance);
}

/// The lobes on which photons are gathered: those of at least `least_alpha`. Frosted glass is followed however rough it
/// is: hardly a photon finds its way to where the camera looks at it, but rays through it find lights well. Curves,
/// which have no area on which to count photons, are followed, too.
template <class AnyBsdf, class Point>
constexpr LobeSet gathering_lobes(const AnyBsdf& bsdf, const Point& point, float least_alpha) {
  constexpr float kRoughest = 1;
  const auto at_least = [](float alpha) { return alpha > kLeastRoughness ? alpha : kLeastRoughness; };
  if constexpr (requires { point.turns; })
    if (point.turns) return 0;
  if (least_alpha == kInfinity) return 0;
  const LobeSet rough = bsdf.lobes(least_alpha);
  if (rough == 0) return 0;
  if (bsdf.transmits(rough)) return bsdf.lobes(std::max(least_alpha, kRoughest));
  if ((bsdf.lobes(kLeastRoughness) & ~rough) == 0) return rough;
  const float beside = least_alpha_beside(rough, bsdf, point);
  const LobeSet joined = beside < least_alpha ? bsdf.lobes(at_least(beside)) : rough;
  return bsdf.transmits(joined) ? rough : joined;
}

/// Returns f of the lobes if it is constant and only one side gets light.
template <class AnyBsdf>
constexpr std::optional<Spectrum> constant_on_one_side(const AnyBsdf& bsdf, LobeSet lobes) {
  return bsdf.transmits(bsdf.lobes(0)) ? std::nullopt : bsdf.lambertian(lobes);
}

/// The lobes that extend the path although they are not specular.
template <class AnyBsdf, class Point>
constexpr LobeSet glossy_lobes(const AnyBsdf& bsdf, const Point& point, float least_alpha) {
  return static_cast<LobeSet>(bsdf.lobes(kLeastRoughness) & ~gathering_lobes(bsdf, point, least_alpha));
}

/// Chooses for light that leaves along wo, by the numbers that a path has at that bounce.
template <class AnyBsdf, class Point>
constexpr LobeChoice choose_lobes(const AnyBsdf& bsdf, const Point& point, const Vec3& wo, float least_alpha,
                                  const PathRandom& random, int bounce) {
  const LobeSet all = bsdf.lobes(0), rough = gathering_lobes(bsdf, point, least_alpha),
                smooth = static_cast<LobeSet>(all & ~rough);
  if (rough == 0 || smooth == 0) return {all, 1, smooth == 0};
  const float rough_chance = bsdf.lobe_probability(wo, rough);
  if (random.number(bounce, kSplit) < rough_chance) return {rough, rough_chance, true};
  return {smooth, 1 - rough_chance, false};
}

}  // namespace dspm
