// The first two dimensions of Sobol's sequence with Owen's nested scrambling [Owen 1995], by hashing [Burley 2020].
//
// Any 2^k points of it that begin at a multiple of 2^k cover the unit square evenly: however it is cut into 2^k equal
// rectangles by halving, each holds one of them. Scrambling keeps this and makes every point uniform.
#pragma once

#include <cstdint>

#include "dspm/base/math/bits.h"

namespace dspm {

constexpr std::uint32_t reverse_bits(std::uint32_t v) {
  v = swapped_bytes(v);
  v = (v >> 4 & 0x0f0f0f0fu) | (v & 0x0f0f0f0fu) << 4;
  v = (v >> 2 & 0x33333333u) | (v & 0x33333333u) << 2;
  return (v >> 1 & 0x55555555u) | (v & 0x55555555u) << 1;
}

/// A bijection in which no bit depends on higher ones: Owen's scrambling of the fraction whose bits these are in reverse
/// order. [Laine and Karras 2011; constants of Vegdahl 2021]
constexpr std::uint32_t scramble_reversed(std::uint32_t v, std::uint32_t seed) {
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= seed >> 16 | 1;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return v;
}

/// Returns the bits of Sobol's second dimension at this index, in reverse order: the matrix is Pascal's triangle modulo 2.
/// The first dimension's, in reverse order, are the index.
constexpr std::uint32_t second_dimension_reversed(std::uint32_t index) {
  index ^= index >> 16;
  index ^= index >> 8 & 0x00ff00ffu;
  index ^= index >> 4 & 0x0f0f0f0fu;
  index ^= index >> 2 & 0x33333333u;
  return index ^ (index >> 1 & 0x55555555u);
}

}  // namespace dspm
