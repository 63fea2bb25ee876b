#include "dspm/integrators/transport/body.h"

#include <algorithm>
#include <vector>

#include "dspm/media/beers_law.h"

namespace dspm {
namespace {

/// Returns null if the body's state in that frame bounds none.
const Material* state_of(const Scene& scene, int body, Frame frame) {
  const Material* state = nullptr;
  for_each_nesting(scene, {&body, 1}, FrameSet::single(frame),
                   [&](FrameSet, std::span<const Material* const> bodies) { state = bodies[0]; });
  return state;
}

/// Returns the bodies around the ray's origin, the outermost first, by what the ray passes, opaque or not: it starts in
/// those that it leaves without having entered them. If it has entered another of equal priority, the surface may be a
/// boundary between the two, and nothing beyond it tells of the origin.
Inside inside_at_start_of(Ray ray, const Scene& scene, Frame frame) {
  constexpr int kMostSurfaces = 64;
  std::vector<int> around;  // the innermost first
  Inside entered;
  for (int i = 0; i < kMostSurfaces; ++i) {
    const HitPartition parts = scene.accel->partition(ray, FrameSet::single(frame));
    if (parts.begin()->hit.missed()) break;
    const Vertex vertex(scene, ray, *parts.begin());
    ray = vertex.point.spawn(ray.direction);
    const Material* body = vertex.body == kNoBody ? nullptr : state_of(scene, vertex.body, frame);
    if (body == nullptr) continue;
    if (!vertex.leads_inside(vertex.wo)) {
      entered.enter(vertex.body);
    } else if (entered.contains(vertex.body)) {
      entered.leave(vertex.body);
    } else {
      const auto is_equal = [&](int other) { return state_of(scene, other, frame)->priority() == body->priority(); };
      if (std::any_of(entered.bodies().begin(), entered.bodies().end(), is_equal)) break;
      around.push_back(vertex.body);
    }
  }
  Inside inside;
  std::for_each(around.rbegin(), around.rend(), [&](int body) { inside.enter(body); });
  return inside;
}

}  // namespace

FrameArray<FrameFactor> left_within(const Scene& scene, const Inside& inside, FrameSet frames, float distance) {
  FrameArray<FrameFactor> left;
  for_each_nesting(scene, inside.bodies(), frames, [&](FrameSet common, std::span<const Material* const> bodies) {
    const Material* top = top_of(bodies);
    left.add({common, top == nullptr ? Spectrum(1) : left_after(top->absorption(*scene.palette), distance)});
  });
  return left;
}

FrameSet open_frames(const Scene& scene, const Ray& segment, const Inside& inside, FrameSet frames) {
  if (!scene.nests || inside.is_empty()) return frames - scene.accel->occluded(segment, frames);
  FrameSet open;
  for (const FrameHit& part : scene.accel->partition(segment, frames)) {
    if (part.hit.missed()) {
      open |= part.frames;
      continue;
    }
    const Vertex vertex(scene, segment, part);
    if (!is_finite(vertex.point)) continue;
    for (const Boundary& boundary : boundaries_of(scene, vertex, inside))
      if (!boundary.is_there)
        open |= open_frames(scene, beyond(segment, vertex, part.hit.t),
                            vertex.inside_beyond(boundary.arriving, segment.direction), boundary.frames);
  }
  return open;
}

Inside inside_at(const Scene& scene, const Vec3& p, Frame frame) {
  for (const Vec3& side : {Vec3{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}, {-1, 0, 0}})
    if (const Inside inside = inside_at_start_of({p, side}, scene, frame); !inside.is_empty()) return inside;
  return {};
}

}  // namespace dspm
