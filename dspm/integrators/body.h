// Absorption in bodies: the light that a segment keeps of what it carries. A path knows the body that it is in from the
// surface that it entered by. Where it arrives at a body's surface from within, that body counts, whatever the path
// knew: so one that starts in a body, or leaves one body for another around it, errs by a segment at most.
#pragma once

#include <cmath>

#include "dspm/colour/rgb.h"
#include "dspm/integrators/path_step.h"
#include "dspm/math/frame_array.h"
#include "dspm/math/frames.h"
#include "dspm/math/ray.h"
#include "dspm/math/vec.h"
#include "dspm/scene/scene.h"

namespace dspm {

/// exp(-absorption distance), Beer's law. The distance may be infinite.
inline Rgb left_after(const Rgb& absorption, float distance) {
  Rgb left;
  for (int c = 0; c < 3; ++c) left[c] = absorption[c] > 0 ? std::exp(-absorption[c] * distance) : 1;
  return left;
}

/// What `body` lets through over a distance, for each of its states in `frames`.
inline FrameArray<FrameFactor> left_by_body(const Scene& scene, int body, FrameSet frames, float distance) {
  FrameArray<FrameFactor> left;
  scene.materials[static_cast<std::size_t>(body)].for_each(frames, [&](FrameSet common, const Material& material) {
    left.add({common, left_after(material.absorption(), distance)});
  });
  return left;
}

/// The body around a point, found by rays to six sides that pass what is opaque: one of them sees a body if the first
/// surface of any body that it meets shows its inside.
inline int body_at(const Scene& scene, const Vec3& p, Frame frame) {
  constexpr int kMostSurfaces = 32;
  for (const Vec3& side : {Vec3{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}) {
    Ray ray{p, side};
    for (int i = 0; i < kMostSurfaces; ++i) {
      const HitPartition parts = scene.accel->partition(ray, FrameSet::single(frame));
      if (parts.begin()->hit.missed()) break;
      const Vertex vertex(scene, ray, *parts.begin());
      if (const int body = vertex.body_towards(vertex.wo, kNoBody); body != kNoBody) return body;
      if (vertex.bounds_a_body()) break;
      ray = vertex.point.spawn(side);
    }
  }
  return kNoBody;
}

}  // namespace dspm
