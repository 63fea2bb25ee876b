// Russian roulette: paths that carry little are few, and carry more.
#pragma once

#include <algorithm>

#include "dspm/base/colour/spectrum.h"
#include "dspm/integrators/transport/path_step.h"

namespace dspm {

inline constexpr int kFirstRouletteBounce = 4;  // of camera paths

/// A camera path's survival probability after `bounce`: its throughput, as it would be outside glass.
inline float roulette_chance(const Spectrum& throughput, float eta_scale, int bounce) {
  return bounce < kFirstRouletteBounce ? 1 : std::min(1.f, max_component(throughput) / eta_scale);
}

/// Plays Russian roulette: the path survives if u < p, divided by p. Frames share u, so they decide alike if p is
/// equal.
inline bool survives(PathState& path, float p, float u) {
  if (p >= 1) return true;
  if (!(u < p)) return false;
  path.throughput *= 1 / p;
  return true;
}

}  // namespace dspm
