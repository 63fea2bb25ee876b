// Random numbers in sequence, for tests.
#pragma once

#include "dspm/base/math/rng.h"

namespace dspm::test {

class Sequence {
 public:
  explicit Sequence(std::uint64_t seed) : seed_(seed) {}
  float number() { return PathRandom(seed_, Stream::setup, count_++, 0).number(0, 0); }
  Vec2 pair() { return PathRandom(seed_, Stream::setup, count_++, 0).pair(0, 0); }

 private:
  std::uint64_t seed_, count_ = 0;
};

}  // namespace dspm::test
