// The queries of a tree traversal (see traverse.h): the nearest hit in one frame, the nearest hit in each of many
// frames, or whether anything is in the way.
#pragma once

#include <cstdint>

#include "dspm/accel/accel.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/simd.h"

namespace dspm {

/// The nearest hit so far of a ray in one frame, or in frames that cannot differ.
class NearestHit {
 public:
  static constexpr bool kOneFrame = true;
  static constexpr bool kNearestFirst = true;

  /// Accepts hits up to and including the distance `limit`.
  NearestHit(FrameSet frames, float limit) : frames_(frames) { best_.t = limit; }

  FrameSet frames() const { return frames_; }
  float limit() const { return best_.t; }
  float limit(FrameSet) const { return best_.t; }
  bool reaches(float entry, FrameSet) const { return entry <= best_.t; }
  void offer(const RayHit& hit, FrameSet) {
    if (hit.nearer_than(best_)) best_ = hit;
  }
  RayHit hit() const { return best_.missed() ? RayHit{} : best_; }

 private:
  FrameSet frames_;
  RayHit best_;
};

/// Finds out whether anything is in the way in one frame, or in frames that cannot differ.
class AnyHit {
 public:
  static constexpr bool kOneFrame = true;
  static constexpr bool kNearestFirst = false;

  AnyHit(FrameSet frames, float t_max) : frames_(frames), limit_(t_max) {}

  FrameSet frames() const { return frames_; }
  float limit() const { return limit_; }
  float limit(FrameSet) const { return limit_; }
  bool reaches(float entry, FrameSet) const { return entry <= limit_; }
  void offer(const RayHit&, FrameSet) { limit_ = -1; }
  bool found() const { return limit_ < 0; }

 private:
  FrameSet frames_;
  float limit_;
};

/// The nearest hit so far in each frame. A hit shared by several frames is stored once.
class NearestHits {
 public:
  static constexpr bool kOneFrame = false;
  static constexpr bool kNearestFirst = true;

  NearestHits(FrameSet frames, float t_max);

  FrameSet frames() const { return frames_; }
  float limit() const { return limit_; }
  bool reaches(float entry, FrameSet frames) const {
    return entry <= limit_ && (!(open_ & frames).empty() || !(not_nearer_than(entry) & frames).empty());
  }
  /// The largest distance that still counts in one of `frames`.
  float limit(FrameSet frames) const;
  /// Offers a hit in the frames in which the object exists, a subset of the query's.
  void offer(const RayHit& hit, FrameSet frames);
  HitPartition partition() const;

 private:
  /// Returns the frames whose nearest hit so far has distance t or more.
  FrameSet not_nearer_than(float t) const;
  float largest() const;
  void leave_slot(Frame frame);

  FrameSet frames_;
  FrameSet open_;                          // those without a hit
  int groups_;                             // of four frames each: up to the query's highest frame
  float limit_;                            // the largest of the distances
  FrameSet used_;                          // slots in use; never more than frames
  alignas(16) float nearest_[kMaxFrames];  // by frame; minus infinity for frames not in the query
  std::uint8_t slot_[kMaxFrames];          // by frame
  union {                                  // by slot; uninitialised until used, since one is constructed per ray
    FrameSet slot_frames_[kMaxFrames];
  };
  union {
    RayHit slot_hit_[kMaxFrames];
  };
};

/// Finds the frames in which nothing is in the way.
class Unblocked {
 public:
  static constexpr bool kOneFrame = false;
  static constexpr bool kNearestFirst = false;

  Unblocked(FrameSet frames, float t_max) : frames_(frames), t_max_(t_max) {}

  FrameSet frames() const { return frames_; }
  float limit() const { return t_max_; }
  bool reaches(float, FrameSet frames) const { return !(frames & frames_).empty(); }
  float limit(FrameSet) const { return t_max_; }
  void offer(const RayHit&, FrameSet frames) { frames_ -= frames; }

 private:
  FrameSet frames_;
  float t_max_;
};

}  // namespace dspm
