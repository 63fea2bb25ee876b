#include "accel/hits.h"

namespace dspm {

NearestHits::NearestHits(FrameSet frames, float t_max)
    : frames_(frames),
      groups_((kMaxFrames + 3 - std::countl_zero(frames.bits())) / 4),
      limit_(t_max),
      used_(FrameSet::single(0)) {
  for (Frame f = 0; f < 4 * groups_; ++f) {
    nearest_[f] = frames.contains(f) ? t_max : -kInfinity;
    slot_[f] = 0;
  }
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

void NearestHits::leave_slot(Frame frame) {
  const Frame slot = slot_[frame];
  slot_frames_[slot] -= FrameSet::single(frame);
  if (slot_frames_[slot].empty()) used_ -= FrameSet::single(slot);
}

void NearestHits::offer(const RayHit& hit, FrameSet frames) {
  FrameSet taken;
  (not_nearer_than(hit.t) & frames).for_each([&](Frame f) {
    if (nearest_[f] == hit.t && !hit.nearer_than(slot_hit_[slot_[f]])) return;
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
  limit_ = limit(frames_);
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
