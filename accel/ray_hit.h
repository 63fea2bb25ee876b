// What a query answers: a ray's first hit, and the partition of frames by it.
#pragma once

#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// A ray's intersection. `shape` indexes the placed shapes and is negative for a miss.
struct RayHit {
  float t = kInfinity;
  int shape = -1;
  int primitive = 0;
  Vec2 uv;

  constexpr bool missed() const { return shape < 0; }
  /// The order that decides which of two hits is nearer: distance, then shape, then primitive.
  constexpr bool nearer_than(const RayHit& o) const {
    if (t != o.t) return t < o.t;
    if (shape != o.shape) return static_cast<unsigned>(shape) < static_cast<unsigned>(o.shape);
    return primitive < o.primitive;
  }
};

/// The ray's first hit (or a miss) in these frames.
struct FrameHit {
  FrameSet frames;
  RayHit hit;
};

/// The frames of a ray partitioned by its first hit: parts are disjoint, their union is the query's frames, a miss is a
/// part, and no two parts have the same (shape, primitive). Parts are sorted by their lowest frames.
class HitPartition {
 public:
  constexpr void add(FrameSet frames, const RayHit& hit) { parts_.add({frames, hit}); }
  constexpr int size() const { return static_cast<int>(parts_.size()); }
  constexpr FrameHit& operator[](int i) { return parts_[static_cast<std::size_t>(i)]; }
  constexpr const FrameHit& operator[](int i) const { return parts_[static_cast<std::size_t>(i)]; }
  constexpr const FrameHit* begin() const { return parts_.begin(); }
  constexpr const FrameHit* end() const { return parts_.end(); }

 private:
  FrameArray<FrameHit> parts_;
};

}  // namespace dspm
