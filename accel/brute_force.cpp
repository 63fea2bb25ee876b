#include "dspm/accel/brute_force.h"

#include "dspm/accel/cut_query.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/params/params.h"

namespace dspm {
namespace {

/// Calls found(RayHit, frames) for every hit of every shape that exists in one of `frames`.
template <class Found>
void for_each_hit(std::span<const PlacedShape> shapes, const Ray& ray, FrameSet frames, const Found& found) {
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const PlacedShape& placed = shapes[s];
    const FrameSet common = placed.frames & frames;
    if (common.empty()) continue;
    const Ray object_ray = placed.in_object_space() ? placed.to_world.inverse_ray(ray) : ray;
    for (int p = 0; p < placed.shape->primitive_count(); ++p)
      if (const auto hit = first_stop(placed, p, ray, object_ray))
        found(RayHit{hit->t, static_cast<int>(s), p, hit->uv}, common);
  }
}

}  // namespace

HitPartition BruteForce::partition(const Ray& ray, FrameSet frames) const {
  std::array<RayHit, kMaxFrames> nearest;
  for_each_hit(shapes_, ray, frames, [&](const RayHit& hit, FrameSet there) {
    there.for_each([&](Frame f) {
      RayHit& best = nearest[static_cast<std::size_t>(f)];
      if (hit.nearer_than(best)) best = hit;
    });
  });

  HitPartition parts;
  frames.for_each([&](Frame f) {
    const RayHit& hit = nearest[static_cast<std::size_t>(f)];
    for (int i = 0; i < parts.size(); ++i) {
      if (parts[i].hit.shape != hit.shape || parts[i].hit.primitive != hit.primitive) continue;
      parts[i].frames |= FrameSet::single(f);
      return;
    }
    parts.add(FrameSet::single(f), hit);
  });
  return parts;
}

FrameSet BruteForce::occluded(const Ray& ray, FrameSet frames) const {
  FrameSet blocked;
  for_each_hit(shapes_, ray, frames, [&](const RayHit&, FrameSet there) { blocked |= there; });
  return blocked;
}

std::size_t brute_force_bytes(std::span<const PlacedShape>, FrameSet) { return sizeof(BruteForce); }

std::unique_ptr<Accel> make_brute_force(ParamReader& reader, std::span<const PlacedShape> shapes, FrameSet) {
  reader.finish();
  return std::make_unique<BruteForce>(shapes);
}

}  // namespace dspm
