// The chances of Russian roulette, and what it makes of survivors: values, which devices have, too.
#pragma once

#include <algorithm>

#include "dspm/base/colour/spectrum.h"

namespace dspm {

inline constexpr int kFirstRouletteBounce = 4;  // of camera paths

/// A camera path's survival probability after `bounce`: its throughput, as it would be outside glass.
constexpr float roulette_chance(const Spectrum& throughput, float eta_scale, int bounce) {
  return bounce < kFirstRouletteBounce ? 1 : std::min(1.f, max_component(throughput) / eta_scale);
}

/// Returns what is left of a throughput that survives if u < p: nothing, or more than there was.
constexpr Spectrum left_by_roulette(const Spectrum& throughput, float p, float u) {
  return p >= 1 ? throughput : u < p ? throughput * (1 / p) : Spectrum();
}

}  // namespace dspm
