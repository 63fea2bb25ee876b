// The queries of a tree traversal (see traverse.h) in many frames: the nearest hit in each, or where nothing is in the way.
// nearest_hit.h has those of one frame.
#pragma once

#include <cstdint>

#include "dspm/accel/nearest_hit.h"
#include "dspm/accel/ray_hit.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/simd.h"

namespace dspm {

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
