// Bits of whole numbers: on the CPU as in <bit>. nvcc takes the functions of g++ behind those without a word, and makes
// nothing of them on a device.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

namespace dspm {

/// Returns how many bits are set.
constexpr int count_of_bits(std::uint64_t bits) {
#if defined(__CUDA_ARCH__) && !defined(__clang__)
  if (!std::is_constant_evaluated()) return __popcll(bits);
#endif
  return std::popcount(bits);
}

/// Returns the place of the lowest bit that is set; one must be.
constexpr int lowest_bit(std::uint64_t bits) {
#if defined(__CUDA_ARCH__) && !defined(__clang__)
  if (!std::is_constant_evaluated()) return __ffsll(static_cast<long long>(bits)) - 1;
#endif
  return std::countr_zero(bits);
}

/// Returns the four bytes in reverse order.
constexpr std::uint32_t swapped_bytes(std::uint32_t v) {
#if defined(__CUDA_ARCH__) && !defined(__clang__)
  if (!std::is_constant_evaluated()) return __byte_perm(v, 0, 0x0123);
#endif
  return __builtin_bswap32(v);
}

}  // namespace dspm
