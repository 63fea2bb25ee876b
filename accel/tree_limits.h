// Limits what a tree can number.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>

#include "dspm/accel/leaf_numbers.h"

namespace dspm {

/// Throws std::length_error if a tree cannot be made of so many pieces (triangles, or one in several frames, and placed
/// objects), or number so many leaves of one kind: packets of triangles, placed objects, or primitives of crowds.
inline void expect_numbered(std::uint64_t pieces, std::uint64_t leaves) {
  constexpr std::uint64_t kMostPieces = kPlaced;
  if (pieces <= kMostPieces && leaves <= kTwo) return;
  throw std::length_error(
      fmt::format("{} million triangles and objects are too many for one tree; ObjectBegin .. ObjectEnd and "
                  "ObjectInstance store an object once, however often it is placed",
                  pieces / 1'000'000));
}

}  // namespace dspm
