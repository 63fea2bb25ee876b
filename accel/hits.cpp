#include "dspm/accel/hits.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "dspm/base/math/frame_lanes.h"
#include "dspm/base/math/frames.h"

namespace dspm {

NearestHits::NearestHits(FrameSet frames, float t_max)
    : frames_(frames),
      open_(frames),
      groups_((kMaxFrames + 3 - std::countl_zero(frames.bits())) / 4),
      limit_(t_max),
      used_(FrameSet::single(0)) {
  for (int group = 0; group < groups_; ++group)
    _mm_store_ps(nearest_ + 4 * group,
                 _mm_blendv_ps(_mm_set1_ps(-kInfinity), _mm_set1_ps(t_max), lanes_of(frames, group)));
  std::memset(slot_, 0, static_cast<std::size_t>(4 * groups_));
  slot_frames_[0] = frames;
  slot_hit_[0] = RayHit{};
}

FrameSet NearestHits::not_nearer_than(float t) const {
  const __m128 at = _mm_set1_ps(t);
  std::uint64_t bits = 0;
  for (int group = 0; group < groups_; ++group) {
    const __m128 not_nearer = _mm_cmpge_ps(_mm_load_ps(nearest_ + 4 * group), at);
    bits |= static_cast<std::uint64_t>(_mm_movemask_ps(not_nearer)) << 4 * group;
  }
  return FrameSet(bits);
}

float NearestHits::limit(FrameSet frames) const {
  float largest = -kInfinity;
  frames.for_each([&](Frame f) { largest = std::max(largest, nearest_[f]); });
  return largest;
}

float NearestHits::largest() const {
  alignas(16) float four[4];
  __m128 most = _mm_load_ps(nearest_);
  for (int group = 1; group < groups_; ++group) most = _mm_max_ps(most, _mm_load_ps(nearest_ + 4 * group));
  _mm_store_ps(four, most);
  return std::max(std::max(four[0], four[1]), std::max(four[2], four[3]));
}

void NearestHits::leave_slot(Frame frame) {
  const Frame slot = slot_[frame];
  slot_frames_[slot] -= FrameSet::single(frame);
  if (slot_frames_[slot].empty()) used_ -= FrameSet::single(slot);
}

void NearestHits::offer(const RayHit& hit, FrameSet frames) {
  FrameSet taken;
  float farthest = -kInfinity;  // of the distances that this hit replaces
  (frames.count() == 1 ? frames : not_nearer_than(hit.t) & frames).for_each([&](Frame f) {
    if (nearest_[f] < hit.t || (nearest_[f] == hit.t && !hit.nearer_than(slot_hit_[slot_[f]]))) return;
    farthest = std::max(farthest, nearest_[f]);
    leave_slot(f);
    taken |= FrameSet::single(f);
  });
  if (taken.empty()) return;

  const Frame slot = FrameSet(~used_.bits()).lowest();
  used_ |= FrameSet::single(slot);
  slot_frames_[slot] = taken;
  slot_hit_[slot] = hit;
  taken.for_each([&](Frame f) {
    nearest_[f] = hit.t;
    slot_[f] = static_cast<std::uint8_t>(slot);
  });
  open_ -= taken;
  if (open_.empty() && farthest == limit_) limit_ = largest();
}

HitPartition NearestHits::partition() const {
  HitPartition parts;
  for (FrameSet rest = frames_; !rest.empty();) {
    const std::uint8_t slot = slot_[rest.lowest()];
    parts.add(slot_frames_[slot], slot_hit_[slot]);
    rest -= slot_frames_[slot];
  }
  return parts;
}

}  // namespace dspm
