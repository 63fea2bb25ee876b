// The random numbers of paths that start at lights.
#pragma once

#include <cstdint>

#include "dspm/base/math/rng.h"

namespace dspm {

/// Returns the numbers of one of an iteration's paths. They are even among these paths, and independent of those of
/// other iterations, unless all paths are to be `independent`.
inline PathRandom photon_numbers(std::uint64_t seed, Stream stream, std::uint64_t path_index, std::uint64_t iteration,
                                 bool independent) {
  if (independent) return {seed, stream, path_index, iteration};
  return PathRandom::even(seed, stream, iteration, static_cast<std::uint32_t>(path_index));
}

}  // namespace dspm
