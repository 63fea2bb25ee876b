// Randomness as a pure function of (seed, stream, path index, iteration, bounce, dimension), not of the frame, the thread,
// or what other paths did. So frames share their noise, and any path can be replayed alone.
#pragma once

#include <cstdint>

#include "dspm/base/math/owen.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// The purpose of the numbers; streams are independent of each other.
enum class Stream : std::uint64_t { camera, photon, caustic_photon, final_gather, setup, pilot, shutter };

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
  /// The numbers are independent of those of all other paths.
  constexpr PathRandom(std::uint64_t seed, Stream stream, std::uint64_t path_index, std::uint64_t iteration)
      : key_(absorb(key_of(seed, stream, iteration), path_index)) {}

  /// The path has a place in a sequence: any 2^k paths from a multiple of 2^k on sample the square of each slot of the
  /// first bounces evenly (owen.h). Slots are independent, so each path alone has uniform, independent numbers.
  static constexpr PathRandom even(std::uint64_t seed, Stream stream, std::uint64_t sequence, std::uint32_t place) {
    PathRandom random;
    random.key_ = key_of(seed, stream, sequence), random.place_ = reverse_bits(place), random.is_even_ = true;
    return random;
  }

  /// Returns a number in [0, 1), a multiple of 2^-24.
  constexpr float number(int bounce, int dimension) const {
    const std::uint64_t bits = hash(bounce, dimension);
    return to_unit(is_even(bounce, dimension) ? first_even(bits) : high(independent(bits)));
  }
  /// Two independent numbers for the price of one.
  constexpr Vec2 pair(int bounce, int dimension) const {
    const std::uint64_t bits = hash(bounce, dimension);
    if (!is_even(bounce, dimension)) {
      const std::uint64_t both = independent(bits);
      return {to_unit(high(both)), to_unit(low(both))};
    }
    const std::uint32_t x = first_even(bits), y = second_dimension_reversed(reverse_bits(x));
    return {to_unit(x), to_unit(reverse_bits(scramble_reversed(y, low(bits))))};
  }

 private:
  static constexpr std::uint64_t absorb(std::uint64_t key, std::uint64_t input) {
    return mix_bits(mix_bits(key) + 0x9e3779b97f4a7c15u * (input + 1));
  }
  static constexpr std::uint64_t key_of(std::uint64_t seed, Stream stream, std::uint64_t sequence) {
    return absorb(absorb(seed, static_cast<std::uint64_t>(stream)), sequence);
  }
  static constexpr float to_unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
  static constexpr std::uint32_t low(std::uint64_t bits) { return static_cast<std::uint32_t>(bits); }
  static constexpr std::uint32_t high(std::uint64_t bits) { return low(bits >> 32); }

  // Later bounces, and walks below surfaces, would gain nothing: they act through all numbers before.
  constexpr bool is_even(int bounce, int dimension) const { return is_even_ && bounce < 4 && dimension < 16; }
  constexpr std::uint64_t hash(int bounce, int dimension) const {
    const auto slot = static_cast<std::uint64_t>(bounce) << 32 | static_cast<std::uint32_t>(dimension);
    return mix_bits(key_ + 0x9e3779b97f4a7c15u * (slot + 1));
  }
  /// Each slot has an order of its own of the sequence.
  constexpr std::uint32_t first_even(std::uint64_t bits) const { return scramble_reversed(place_, high(bits)); }
  constexpr std::uint64_t independent(std::uint64_t bits) const { return is_even_ ? absorb(bits, place_) : bits; }

  std::uint64_t key_ = 0;
  std::uint32_t place_ = 0;  // with its bits in reverse order
  bool is_even_ = false;
};

}  // namespace dspm
