#include "accel/two_level.h"

namespace dspm {
namespace {

ShapesByKind those_which(std::span<const PlacedShape> shapes, FrameSet all, bool stand_still) {
  std::vector<int> numbers;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const FrameSet there = shapes[s].frames & all;
    if (!there.empty() && (there == all) == stand_still) numbers.push_back(static_cast<int>(s));
  }
  return by_kind(shapes, numbers);
}

HitPartition one_part(FrameSet frames, const RayHit& hit) {
  HitPartition parts;
  parts.add(frames, hit);
  return parts;
}

}  // namespace

TwoLevel::TwoLevel(std::span<const PlacedShape> shapes, FrameSet all)
    : static_(shapes, those_which(shapes, all, true), all), dynamic_(shapes, those_which(shapes, all, false), all) {}

RayHit TwoLevel::nearest(const Ray& ray, FrameSet frames) const {
  NearestHit nearest(frames, ray.t_max);
  static_.find(ray, nearest);
  if (!dynamic_.empty()) dynamic_.find(ray, nearest);
  return nearest.hit();
}

HitPartition TwoLevel::partition(const Ray& ray, FrameSet frames) const {
  if (frames.empty()) return {};
  if (frames.count() == 1 || dynamic_.empty()) return one_part(frames, nearest(ray, frames));

  NearestHits hits(frames, ray.t_max);
  dynamic_.find(ray, hits);
  NearestHit nearest(frames, hits.limit());
  static_.find(ray, nearest);
  if (!nearest.hit().missed()) hits.offer(nearest.hit(), frames);
  return hits.partition();
}

FrameSet TwoLevel::occluded(const Ray& ray, FrameSet frames) const {
  if (frames.empty() || static_.occluded(ray)) return frames;
  if (dynamic_.empty()) return {};
  Unblocked unblocked(frames, ray.t_max);
  dynamic_.find(ray, unblocked);
  return frames - unblocked.frames();
}

std::unique_ptr<Accel> make_two_level(ParamReader& reader, std::span<const PlacedShape> shapes, FrameSet all) {
  reader.finish();
  return std::make_unique<TwoLevel>(shapes, all);
}

}  // namespace dspm
