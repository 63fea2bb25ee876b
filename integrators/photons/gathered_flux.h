// The flux that photons bring to a hit point: one sum for photons of all its frames, and sums frame by frame for the
// rest.
#pragma once

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/gather.h"

namespace dspm {

class GatheredFlux {
 public:
  GatheredFlux(const HitPoint& hit, const PhotonMap& map) : frames_(hit.frames), map_(map) {}

  /// Adds what gather() reports of a photon; `frames` may be fewer.
  void add(const Strand* strands, FrameSet frames, RgbLanes flux) {
    if (strands == nullptr && frames == frames_)
      shared_ += flux;
    else if (strands == nullptr)
      add_own(frames, flux);
    else if (RgbLanes* sum = frames == frames_ && map_.is_of_light(strands) ? lists_.of(strands) : nullptr)
      *sum += flux;
    else
      add_strands(strands, frames, flux);
  }
  /// Call this after the last photon and before reading the sums.
  void end() {
    lists_.for_each([&](const Strand* list, RgbLanes flux) { add_strands(list, frames_, flux); });
  }

  Rgb shared() const { return shared_.rgb(); }
  /// The frames that received more than shared().
  FrameSet with_own() const { return with_own_; }
  Rgb own(Frame frame) const { return RgbLanes(own_[frame]).rgb(); }
  Rgb in(Frame frame) const { return with_own_.contains(frame) ? shared() + own(frame) : shared(); }

 private:
  void add_own(FrameSet frames, RgbLanes flux) {
    (frames - with_own_).for_each([&](Frame f) { own_[f] = _mm_setzero_ps(); });
    with_own_ |= frames;
    frames.for_each([&](Frame f) { own_[f] = _mm_add_ps(own_[f], flux.lanes); });
  }
  void add_strands(const Strand* strands, FrameSet frames, RgbLanes flux) {
    for_each_strand(strands, frames, [&](FrameSet alike, const Rgb& weight) {
      add_own(alike, RgbLanes(_mm_mul_ps(flux.lanes, RgbLanes(weight).lanes)));
    });
  }

  FrameSet frames_;
  const PhotonMap& map_;
  RgbLanes shared_;
  FewListSums<RgbLanes> lists_;
  FrameSet with_own_;
  __m128 own_[kMaxFrames];  // valid only for the frames in with_own_
};

}  // namespace dspm
