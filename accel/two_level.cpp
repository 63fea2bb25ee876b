#include "dspm/accel/two_level.h"

#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"

namespace dspm {
namespace {

// For more frames than this, the tree over all of them is faster. Measured on a galloping horse of 17K triangles.
constexpr int kFewFrames = 3;

HitPartition one_part(FrameSet frames, const RayHit& hit) {
  HitPartition parts;
  parts.add(frames, hit);
  return parts;
}

}  // namespace

template <class Query>
void TwoLevel::find_dynamic(const TreeRay& ray, Query& query) const {
  if (of_frame_.empty() || query.frames().count() > kFewFrames) return dynamic_.find(ray, query);
  query.frames().for_each([&](Frame f) { of_frame_[static_cast<std::size_t>(f)].find(ray, query); });
}

HitPartition TwoLevel::partition(const Ray& ray, FrameSet frames) const {
  if (frames.empty()) return {};
  const TreeRay prepared(ray, margins_);
  NearestHit nearest(frames, ray.t_max);
  if (frames.count() == 1) {
    if (!dynamic_.empty()) find_dynamic(prepared, nearest);
    static_.find(prepared, nearest);
    return one_part(frames, nearest.hit());
  }
  static_.find(prepared, nearest);
  // Most rays end here, without the data structures for many frames.
  if (!dynamic_.enters(prepared, nearest.limit())) return one_part(frames, nearest.hit());
  NearestHits hits(frames, nearest.limit());
  if (!nearest.hit().missed()) hits.offer(nearest.hit(), frames);
  find_dynamic(prepared, hits);
  return hits.partition();
}

FrameSet TwoLevel::occluded(const Ray& ray, FrameSet frames) const {
  const TreeRay prepared(ray, margins_);
  AnyHit any(frames, ray.t_max);
  static_.find(prepared, any);
  if (any.found() || !dynamic_.enters(prepared, ray.t_max)) return any.found() ? frames : FrameSet();
  if (frames.count() == 1) {
    find_dynamic(prepared, any);
    return any.found() ? frames : FrameSet();
  }
  Unblocked unblocked(frames, ray.t_max);
  find_dynamic(prepared, unblocked);
  return frames - unblocked.frames();
}

}  // namespace dspm
