// Randomness as a pure function. A number depends on (seed, stream, path index, iteration, bounce, dimension) and on
// nothing else: not on the frame, the thread, or what other paths did. So frames share their noise, and any path can be
// replayed alone.
#pragma once

#include <cstdint>

#include "dspm/base/math/owen.h"
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
  /// The numbers are independent of those of all other paths.
  constexpr PathRandom(std::uint64_t seed, Stream stream, std::uint64_t path_index, std::uint64_t iteration)
      : key_(absorb(key_of(seed, stream, iteration), path_index)) {}

  /// A path that has a place in a sequence of paths, whose numbers together are even: each slot of the first bounces is
  /// a sequence as in owen.h, and slots are independent of one another. So any 2^k paths from a place that is a multiple
  /// of 2^k sample a slot's square evenly. The numbers of each path alone are uniform and independent.
  static constexpr PathRandom even(std::uint64_t seed, Stream stream, std::uint64_t sequence, std::uint32_t place) {
    PathRandom random;
    random.key_ = key_of(seed, stream, sequence);
    random.place_reversed_ = reverse_bits(place), random.is_even_ = true;
    return random;
  }

  /// Returns a number in [0, 1), a multiple of 2^-24.
  constexpr float number(int bounce, int dimension) const {
    const std::uint64_t bits = hash(bounce, dimension);
    return is_even(bounce, dimension) ? to_unit(first_even(bits)) : to_unit(independent(bits));
  }
  /// Two independent numbers for the price of one.
  constexpr Vec2 pair(int bounce, int dimension) const {
    const std::uint64_t bits = hash(bounce, dimension);
    if (is_even(bounce, dimension)) {
      const std::uint32_t x = first_even(bits), index = reverse_bits(x);
      return {to_unit(x), to_unit(reverse_bits(scramble_reversed(second_dimension_reversed(index), low(bits))))};
    }
    const std::uint64_t both = independent(bits);
    return {to_unit(both), to_unit(both << 32)};
  }

 private:
  // Later bounces, and walks below surfaces, gain nothing: their numbers act through those of the bounces before.
  static constexpr int kEvenBounces = 4, kEvenDimensions = 8;

  static constexpr std::uint64_t absorb(std::uint64_t key, std::uint64_t input) {
    return mix_bits(mix_bits(key) + 0x9e3779b97f4a7c15u * (input + 1));
  }
  static constexpr std::uint64_t key_of(std::uint64_t seed, Stream stream, std::uint64_t sequence) {
    return absorb(absorb(seed, static_cast<std::uint64_t>(stream)), sequence);
  }
  static constexpr float to_unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
  static constexpr float to_unit(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }
  static constexpr std::uint32_t low(std::uint64_t bits) { return static_cast<std::uint32_t>(bits); }

  constexpr bool is_even(int bounce, int dimension) const {
    return is_even_ && bounce < kEvenBounces && dimension < kEvenDimensions;
  }
  constexpr std::uint64_t hash(int bounce, int dimension) const {
    const auto slot = static_cast<std::uint64_t>(static_cast<std::uint32_t>(bounce)) << 32 |
                      static_cast<std::uint64_t>(static_cast<std::uint32_t>(dimension));
    return mix_bits(key_ + 0x9e3779b97f4a7c15u * (slot + 1));
  }
  /// The slot has an order of its own of the sequence: the place, scrambled as if it were a fraction.
  constexpr std::uint32_t first_even(std::uint64_t bits) const {
    return scramble_reversed(place_reversed_, low(bits >> 32));
  }
  constexpr std::uint64_t independent(std::uint64_t bits) const {
    return is_even_ ? absorb(bits, place_reversed_) : bits;
  }

  std::uint64_t key_ = 0;
  std::uint32_t place_reversed_ = 0;
  bool is_even_ = false;
};

}  // namespace dspm
