// Where a ray meets what parts media without scattering light.
#pragma once

#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// What a ray meets first in these frames: a surface, a boundary of media, or nothing.
struct Meeting {
  FrameSet frames;
  RayHit hit;
  bool is_boundary;
};

/// Returns the boundaries that the ray meets first, frame by frame, and misses.
inline FrameArray<Meeting> boundaries_along(const Scene& scene, const Ray& ray, FrameSet frames) {
  FrameArray<Meeting> meetings;
  if (scene.boundaries == nullptr) {
    meetings.add({frames, RayHit{}, false});
    return meetings;
  }
  for (const FrameHit& part : scene.boundaries->accel->partition(ray, frames))
    meetings.add({part.frames, part.hit, !part.hit.missed()});
  return meetings;
}

/// Returns what the ray meets first, frame by frame, from near to far. Of a surface and a boundary at the same place, the
/// surface counts.
FrameArray<Meeting> meetings_along(const Scene& scene, const Ray& ray, FrameSet frames);

/// Returns the frames in which the ray starts in a medium that gives off light. Surfaces that part no media do not tell.
FrameSet frames_in(const Glow& glow, const Scene& scene, const Ray& ray, FrameSet frames);

/// A point of a boundary, as a ray of that direction meets it.
class BoundaryPoint {
 public:
  BoundaryPoint(const MediumBoundaries& boundaries, const RayHit& hit, const Vec3& direction)
      : point_(boundaries.shapes[static_cast<std::size_t>(hit.shape)].seen(hit.primitive, hit.uv, direction)),
        interface_(boundaries.interfaces[static_cast<std::size_t>(hit.shape)]) {}

  int medium_beyond(const Vec3& direction) const { return interface_.medium_towards(dot(direction, point_.ng) > 0); }
  /// Returns the rest of the ray, which has met the boundary at `distance`.
  Ray beyond(const Ray& ray, float distance) const { return point_.spawn(ray.direction, ray.t_max - distance); }

 private:
  SurfacePoint point_;
  const MediumInterface& interface_;
};

}  // namespace dspm
