// The query of accel.h as devices answer it: one tree of what is the same in all frames, and one a frame of what is not
// (or one for all of them). A device has no room for a nearest distance per frame, so it looks for each frame by itself.
#pragma once

#include "dspm/accel/nearest_hit.h"
#include "dspm/accel/plain_tree.h"
#include "dspm/accel/ray_hit.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"

namespace dspm {

struct PlainQuery {
  PlainTree still;
  const PlainTree* moving = nullptr;  // null: nothing moves
  bool by_frame = false;              // there is one for each frame, else one for all

  constexpr const PlainTree& moving_in(Frame frame) const { return moving[by_frame ? frame : 0]; }

  /// Returns what Accel::partition() returns.
  constexpr HitPartition partition(const Ray& ray, FrameSet frames) const {
    HitPartition parts;
    NearestHit nearest(frames, ray.t_max);
    find(still, ray, nearest);
    if (moving == nullptr) {
      if (!frames.empty()) parts.add(frames, nearest.hit());
      return parts;
    }
    frames.for_each([&](Frame f) {
      NearestHit own = nearest.in(FrameSet::single(f));
      find(moving_in(f), ray, own);
      add(parts, f, own.hit());
    });
    return parts;
  }

  /// Returns what Accel::occluded() returns.
  constexpr FrameSet occluded(const Ray& ray, FrameSet frames) const {
    AnyHit any(frames, ray.t_max);
    find(still, ray, any);
    if (any.found()) return frames;
    FrameSet blocked;
    if (moving == nullptr) return blocked;
    frames.for_each([&](Frame f) {
      AnyHit own(FrameSet::single(f), ray.t_max);
      find(moving_in(f), ray, own);
      if (own.found()) blocked |= FrameSet::single(f);
    });
    return blocked;
  }

 private:
  static constexpr void add(HitPartition& parts, Frame frame, const RayHit& hit) {
    for (int i = 0; i < parts.size(); ++i) {
      if (parts[i].hit.shape != hit.shape || parts[i].hit.primitive != hit.primitive) continue;
      parts[i].frames |= FrameSet::single(frame);
      return;
    }
    parts.add(FrameSet::single(frame), hit);
  }
};

}  // namespace dspm
