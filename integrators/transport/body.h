// Absorption in bodies: the light that a segment keeps of what it carries. A path knows the bodies that it is in from
// the surfaces that it has crossed. If it arrives at a body's surface from within, it is in that body, whatever it
// knew.
#pragma once

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/left_in_media.h"
#include "dspm/integrators/transport/nesting.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns the share of light that is left after a distance, perhaps infinite, in these bodies, for each of their
/// states in `frames`.
FrameArray<FrameFactor> left_within(const Scene& scene, const Inside& inside, FrameSet frames, float distance);

/// Returns the rest of a ray that a surface that is not there lets pass; `distance` is where the ray has met it.
inline Ray beyond(const Ray& ray, const Vertex& vertex, float distance) {
  return vertex.point.spawn(ray.direction, ray.t_max - distance);
}

/// Returns the frames in which nothing blocks the segment, which lies in these bodies where it starts. A surface that
/// is not there does not block it.
FrameSet open_frames(const Scene& scene, const Ray& segment, const Inside& inside, FrameSet frames);

/// Calls fn(FrameSet, const Spectrum& transmittance) for the frames in which nothing blocks the segment, which lies in these
/// bodies, in a scene without media.
template <class Fn>
void for_each_open(const Scene& scene, const Ray& segment, const Inside& inside, FrameSet frames, Fn&& fn) {
  const FrameSet open = open_frames(scene, segment, inside, frames);
  if (open.empty()) return;
  if (inside.is_empty()) return fn(open, Spectrum(1));
  for (const FrameFactor& left : left_within(scene, inside, open, segment.t_max)) fn(left.frames, left.factor);
}

/// The same in any scene: the segment starts in the medium that `inside` names.
template <class Fn>
void for_each_open(const Scene& scene, const Ray& segment, const Inside& inside, FrameSet frames,
                   const SegmentNumbers& numbers, Fn&& fn) {
  if (scene.media.empty()) return for_each_open(scene, segment, inside, frames, fn);
  const FrameSet open = open_frames(scene, segment, inside, frames);
  if (open.empty()) return;
  for (const FrameFactor& media : left_in_media(scene, segment, inside.medium, open, numbers))
    for (const FrameFactor& left : left_within(scene, inside, media.frames, segment.t_max))
      fn(left.frames, media.factor * left.factor);
}

/// Returns the bodies around a point in a frame.
Inside inside_at(const Scene& scene, const Vec3& p, Frame frame);

}  // namespace dspm
