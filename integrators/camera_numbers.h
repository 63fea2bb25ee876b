// The random numbers of a pixel's camera paths.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "dspm/base/math/owen.h"
#include "dspm/base/math/rng.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/tiles.h"

namespace dspm {

/// Returns a number below 2^32 whose even bits are those of x < 2^16, and whose odd bits those of y: points in Z-order.
constexpr std::uint32_t interleave_bits(std::uint32_t x, std::uint32_t y) {
  const auto spread = [](std::uint32_t v) {
    v = (v | v << 8) & 0x00ff00ffu;
    v = (v | v << 4) & 0x0f0f0f0fu;
    v = (v | v << 2) & 0x33333333u;
    return (v | v << 1) & 0x55555555u;
  };
  return spread(x) | spread(y) << 1;
}

/// A block of iterations, whose even numbers are independent of those of other blocks: four, and then as many as there
/// were before, so that estimates of the error may compare halves.
struct IterationBlock {
  static constexpr std::uint64_t kFirst = 4, kLargest = 1 << 16;
  std::uint64_t first, length;

  static constexpr IterationBlock of(std::uint64_t iteration) {
    const std::uint64_t length = std::clamp(std::bit_floor(iteration), kFirst, kLargest);
    return {iteration / length * length, length};
  }
};

/// Returns the numbers of a pixel's path in an iteration. In a block, all pixels of a large square share a sequence, in
/// Z-order: errors cancel in squares of 2 x 2, 4 x 4, ... pixels and are blue noise [Ahmed and Wonka 2020].
inline PathRandom camera_numbers(const RenderSettings& render, std::uint64_t seed, int x, int y,
                                 std::uint64_t iteration) {
  if (render.independent_numbers) return {seed, Stream::camera, camera_path_index(render, x, y), iteration};
  constexpr int kSquareBits = 8;  // a square's pixels times the largest block's iterations: 2^32 places
  constexpr std::uint32_t kInSquare = (1 << kSquareBits) - 1;
  const auto [first, length] = IterationBlock::of(iteration);
  const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
  const std::uint64_t square = static_cast<std::uint64_t>(row >> kSquareBits) << 32 | column >> kSquareBits;
  const std::uint32_t place = interleave_bits(column & kInSquare, row & kInSquare) * static_cast<std::uint32_t>(length);
  return PathRandom::even(mix_bits(seed ^ square), Stream::camera, first,
                          place + static_cast<std::uint32_t>(iteration - first));
}

}  // namespace dspm
