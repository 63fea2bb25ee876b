// Russian roulette: paths that carry little are few, and carry more.
#pragma once

#include "dspm/integrators/transport/path_step.h"
#include "dspm/integrators/transport/roulette_chance.h"

namespace dspm {

/// Plays Russian roulette: the path survives if u < p, divided by p. Frames share u, so they decide alike if p is
/// equal.
inline bool survives(PathState& path, float p, float u) {
  if (p >= 1) return true;
  if (!(u < p)) return false;
  path.throughput *= 1 / p;
  return true;
}

}  // namespace dspm
