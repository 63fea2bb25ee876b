// Randomness as a pure function. A number depends on (seed, stream, path index, iteration, bounce, dimension) and on
// nothing else: not on the frame, the thread, or what other paths did. So frames share their noise, and any path can be
// replayed alone.
#pragma once

#include <cstdint>

#include "dspm/base/math/vec.h"

namespace dspm {

/// The purpose of the numbers; streams are independent of each other.
enum class Stream : std::uint64_t { camera, photon, caustic_photon, final_gather, setup, pilot };

/// A bijection on 64 bits in which every output bit depends on every input bit. [Steele et al. 2014, SplitMix64;
/// Stafford's variant 13 of the murmur3 finaliser]
constexpr std::uint64_t mix_bits(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return v ^ (v >> 31);
}

/// The random numbers of one path. A slot (bounce, dimension) holds a number or a pair, not both: the first component
/// of the pair is the slot's number. Each sampler chooses slots that no other uses.
class PathRandom {
 public:
  constexpr PathRandom() = default;
  constexpr PathRandom(std::uint64_t seed, Stream stream, std::uint64_t path_index, std::uint64_t iteration)
      : key_(absorb(absorb(absorb(seed, static_cast<std::uint64_t>(stream)), iteration), path_index)) {}

  /// Returns a number in [0, 1), a multiple of 2^-24.
  constexpr float number(int bounce, int dimension) const { return to_unit(hash(bounce, dimension)); }
  /// Two independent numbers for the price of one.
  constexpr Vec2 pair(int bounce, int dimension) const {
    const std::uint64_t bits = hash(bounce, dimension);
    return {to_unit(bits), to_unit(bits << 32)};
  }

 private:
  static constexpr std::uint64_t absorb(std::uint64_t key, std::uint64_t input) {
    return mix_bits(mix_bits(key) + 0x9e3779b97f4a7c15u * (input + 1));
  }
  static constexpr float to_unit(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

  constexpr std::uint64_t hash(int bounce, int dimension) const {
    const auto slot = static_cast<std::uint64_t>(static_cast<std::uint32_t>(bounce)) << 32 |
                      static_cast<std::uint64_t>(static_cast<std::uint32_t>(dimension));
    return mix_bits(key_ + 0x9e3779b97f4a7c15u * (slot + 1));
  }

  std::uint64_t key_ = 0;
};

}  // namespace dspm
