// Random numbers, points and directions for the tests of shapes; the same on every machine.
#pragma once

#include <cstdint>

#include "dspm/base/math/vec.h"

namespace dspm::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {  // splitmix64
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  float uniform() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }  // [0, 1)
  float uniform(float low, float high) { return low + (high - low) * uniform(); }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
  /// 10^x with x uniform in [low, high).
  float magnitude(float low, float high) { return std::pow(10.f, uniform(low, high)); }
  Vec2 square() { return {uniform(), uniform()}; }
  Vec3 in_cube(float r) { return {uniform(-r, r), uniform(-r, r), uniform(-r, r)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = in_cube(1);
      if (length2(v) > 0.01f && length2(v) <= 1) return normalize(v);
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace dspm::test
