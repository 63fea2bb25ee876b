// The distance test of every gather: which points of a run lie within a radius. Uses the widest SIMD available.
#pragma once

#include <cstdint>

#include "dspm/base/math/vec.h"

namespace dspm {

/// The instructions to use. All give the same bits.
enum class DistanceTest { four_lanes, sixteen_lanes };  // SSE or NEON, AVX-512

bool is_supported(DistanceTest test);
extern const DistanceTest kWidestDistanceTest;

/// Points within a radius, found without branches: about one in three qualifies, too irregularly for branch prediction.
class PointsWithin {
 public:
  static constexpr std::uint32_t kPadding = 15;

  PointsWithin(const Vec3& p, float radius2, DistanceTest test = kWidestDistanceTest)
      : p_(p), radius2_(radius2), test_(test) {}

  /// Tests the points begin .. end - 1, whose coordinates must be readable up to end + kPadding. Stops when its buffer
  /// is full; returns the end of the tested range.
  std::uint32_t add(const float* x, const float* y, const float* z, std::uint32_t begin, std::uint32_t end) {
    return test_ == DistanceTest::sixteen_lanes ? add_sixteen(x, y, z, begin, end) : add_four(x, y, z, begin, end);
  }
  bool full() const { return count_ > kRoom - kMostLanes; }
  /// Calls fn(point number, distance squared) for all found points, in the order in which they were added.
  template <class Fn>
  void empty_into(Fn&& fn) {
    for (std::uint32_t k = 0; k < count_; ++k) fn(numbers_[k], distance2_[k]);
    count_ = 0;
  }

 private:
  static constexpr std::uint32_t kMostLanes = 16, kRoom = 128;

  std::uint32_t add_four(const float* x, const float* y, const float* z, std::uint32_t begin, std::uint32_t end);
  std::uint32_t add_sixteen(const float* x, const float* y, const float* z, std::uint32_t begin, std::uint32_t end);

  Vec3 p_;
  float radius2_;
  DistanceTest test_;
  std::uint32_t count_ = 0;
  std::uint32_t numbers_[kRoom];
  float distance2_[kRoom];
};

}  // namespace dspm
