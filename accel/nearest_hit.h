// The queries of a traversal in one frame, or in frames that cannot differ: the nearest hit, or whether there is any.
// hits.h has those of many frames.
#pragma once

#include "dspm/accel/ray_hit.h"
#include "dspm/base/math/frames.h"

namespace dspm {

/// The nearest hit so far of a ray in one frame, or in frames that cannot differ.
class NearestHit {
 public:
  static constexpr bool kOneFrame = true;
  static constexpr bool kNearestFirst = true;

  /// Accepts hits up to and including the distance `limit`.
  constexpr NearestHit(FrameSet frames, float limit) : frames_(frames) { best_.t = limit; }

  constexpr FrameSet frames() const { return frames_; }
  constexpr float limit() const { return best_.t; }
  constexpr float limit(FrameSet) const { return best_.t; }
  constexpr bool reaches(float entry, FrameSet) const { return entry <= best_.t; }
  constexpr void offer(const RayHit& hit, FrameSet) {
    if (hit.nearer_than(best_)) best_ = hit;
  }
  constexpr RayHit hit() const { return best_.missed() ? RayHit{} : best_; }
  /// Returns the same for some of the frames.
  constexpr NearestHit in(FrameSet frames) const {
    NearestHit some = *this;
    some.frames_ = frames;
    return some;
  }

 private:
  FrameSet frames_;
  RayHit best_;
};

/// Finds out whether anything is in the way in one frame, or in frames that cannot differ.
class AnyHit {
 public:
  static constexpr bool kOneFrame = true;
  static constexpr bool kNearestFirst = false;

  constexpr AnyHit(FrameSet frames, float t_max) : frames_(frames), limit_(t_max) {}

  constexpr FrameSet frames() const { return frames_; }
  constexpr float limit() const { return limit_; }
  constexpr float limit(FrameSet) const { return limit_; }
  constexpr bool reaches(float entry, FrameSet) const { return entry <= limit_; }
  constexpr void offer(const RayHit&, FrameSet) { limit_ = -1; }
  constexpr bool found() const { return limit_ < 0; }

 private:
  FrameSet frames_;
  float limit_;
};

}  // namespace dspm
