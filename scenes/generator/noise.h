// Smooth noise that repeats: it makes wood look grown and cloth woven.
#pragma once

#include <cstdint>

namespace dspm {

/// In 0..1, of period 1 in both directions; `columns` x `rows` random values per period.
float noise(std::uint64_t seed, float x, float y, int columns, int rows);

/// Octaves of it, each of half the size and half the strength of the one before; in 0..1.
float layered_noise(std::uint64_t seed, float x, float y, int columns, int rows, int octaves);

}  // namespace dspm
