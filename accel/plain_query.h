// The query of accel.h as devices answer it: one tree of what is the same in all frames, and one a frame of what is not.
// A device has no room for a nearest distance per frame, so it looks for each frame by itself. Queries know no textures, so
// who asks brings the holes of the shapes along (NoHoles).
#pragma once

#include <cstddef>

#include "dspm/accel/nearest_hit.h"
#include "dspm/accel/plain_tree.h"
#include "dspm/accel/ray_hit.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"

namespace dspm {

struct PlainQuery {
  PlainTree still;
  PlainTree moving;                     // all that is not the same in all frames
  const PlainTree* of_frame = nullptr;  // the same frame by frame; null: there are no such trees
  float margins = 1;                    // the most that one of the trees needs
  std::size_t frame_count = 0;          // that have trees

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    still.each_array(fn);
    moving.each_array(fn);
    fn(of_frame, frame_count);
  }

  /// Returns what Accel::partition() returns if shapes have these holes.
  template <class Holes>
  constexpr HitPartition partition(const Ray& r, FrameSet frames, const Holes& holes) const {
    HitPartition parts;
    const PlainRay ray(r, margins);
    NearestHit nearest(frames, r.t_max);
    find(still, ray, nearest, holes);
    if (!enters(moving, ray, nearest.limit())) {
      if (!frames.empty()) parts.add(frames, nearest.hit());
      return parts;
    }
    frames.for_each([&](Frame f) {
      NearestHit own = nearest.in(FrameSet::single(f));
      find(moving_in(f), ray, own, holes);
      add(parts, f, own.hit());
    });
    return parts;
  }

  /// Returns what Accel::occluded() returns if shapes have these holes.
  template <class Holes>
  constexpr FrameSet occluded(const Ray& r, FrameSet frames, const Holes& holes) const {
    const PlainRay ray(r, margins);
    AnyHit any(frames, r.t_max);
    find(still, ray, any, holes);
    if (any.found()) return frames;
    FrameSet blocked;
    if (!enters(moving, ray, r.t_max)) return blocked;
    frames.for_each([&](Frame f) {
      AnyHit own(FrameSet::single(f), r.t_max);
      find(moving_in(f), ray, own, holes);
      if (own.found()) blocked |= FrameSet::single(f);
    });
    return blocked;
  }

 private:
  constexpr const PlainTree& moving_in(Frame frame) const { return of_frame != nullptr ? of_frame[frame] : moving; }

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
