#include "accel/two_level.h"

namespace dspm {
namespace {

HitPartition one_part(FrameSet frames, const RayHit& hit) {
  HitPartition parts;
  parts.add(frames, hit);
  return parts;
}

}  // namespace

ShapesByKind static_shapes(std::span<const PlacedShape> shapes, FrameSet all) {
  return by_kind(shapes, [all](const PlacedShape& s) { return s.frames.contains(all); });
}

ShapesByKind dynamic_shapes(std::span<const PlacedShape> shapes, FrameSet all) {
  return by_kind(shapes, [all](const PlacedShape& s) { return !s.frames.contains(all) && !(s.frames & all).empty(); });
}

TwoLevel::TwoLevel(std::span<const PlacedShape> shapes, FrameSet all)
    : static_(shapes, static_shapes(shapes, all), all), dynamic_(shapes, dynamic_shapes(shapes, all), all) {}

RayHit TwoLevel::nearest(const Ray& ray, FrameSet frames) const {
  NearestHit nearest(frames, ray.t_max);
  if (!dynamic_.empty()) dynamic_.find(ray, nearest);
  static_.find(ray, nearest);
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
