// A sample of a Bsdf, or of a plain one that a device has, by a path's numbers.
#pragma once

#include <optional>

#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/dimension.h"
#include "dspm/materials/bsdf.h"

namespace dspm {

/// Samples `lobes` by the numbers that a path has at that bounce.
template <class AnyBsdf>
constexpr std::optional<BsdfSample> sample_bsdf(const AnyBsdf& bsdf, const Vec3& wo, Transport transport, LobeSet lobes,
                                                const PathRandom& random, int bounce) {
  const Vec2 u = random.pair(bounce, kScatter);
  return bsdf.sample(wo, {u.x, u.y, random.number(bounce, kLobe)}, transport, lobes);
}

}  // namespace dspm
