// Which lobes of a surface gather photons, and which extend the path.
#pragma once

#include <algorithm>
#include <cmath>

#include "dspm/base/math/vec.h"
#include "dspm/integrators/dimension.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/materials/bsdf.h"
#include "dspm/world/scene/scene.h"

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
inline float least_alpha_beside(LobeSet rough, const Bsdf& bsdf, const SurfacePoint& point) {
  const float chance = bsdf.lobe_probability(point.ns, rough);
  return 0.5f * std::sqrt(std::max(0.f, 1 - chance) / chance);
}

/// The lobes on which photons are gathered: those of at least `least_alpha`. Frosted glass is followed however rough it
/// is: hardly a photon finds its way to where the camera looks at it, but rays through it find lights well. Curves,
/// which have no area on which to count photons, are followed, too.
inline LobeSet gathering_lobes(const Bsdf& bsdf, const SurfacePoint& point, float least_alpha) {
  constexpr float kRoughest = 1;
  if (point.turns || least_alpha == kInfinity) return 0;
  const LobeSet rough = bsdf.lobes(least_alpha);
  if (rough == 0) return 0;
  if (bsdf.transmits(rough)) return bsdf.lobes(std::max(least_alpha, kRoughest));
  if ((bsdf.lobes(kLeastRoughness) & ~rough) == 0) return rough;
  const float beside = least_alpha_beside(rough, bsdf, point);
  const LobeSet joined = beside < least_alpha ? bsdf.lobes(std::max(beside, kLeastRoughness)) : rough;
  return bsdf.transmits(joined) ? rough : joined;
}

/// The lobes that extend the path although they are not specular.
inline LobeSet glossy_lobes(const Bsdf& bsdf, const SurfacePoint& point, float least_alpha) {
  return static_cast<LobeSet>(bsdf.lobes(kLeastRoughness) & ~gathering_lobes(bsdf, point, least_alpha));
}

inline LobeChoice choose_lobes(const Bsdf& bsdf, const PathState& path, const Vertex& vertex, float least_alpha) {
  const LobeSet all = bsdf.all_lobes(), rough = gathering_lobes(bsdf, vertex.point, least_alpha),
                smooth = static_cast<LobeSet>(all & ~rough);
  if (rough == 0 || smooth == 0) return {all, 1, smooth == 0};
  const float rough_chance = bsdf.lobe_probability(vertex.wo, rough);
  if (path.random.number(path.bounces, kSplit) < rough_chance) return {rough, rough_chance, true};
  return {smooth, 1 - rough_chance, false};
}

}  // namespace dspm
