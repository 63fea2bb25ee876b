#include "dspm/integrators/transport/medium_boundary.h"

#include <algorithm>

namespace dspm {

FrameArray<Meeting> meetings_along(const Scene& scene, const Ray& ray, FrameSet frames) {
  FrameArray<Meeting> meetings;
  for (const FrameHit& surface : scene.accel->partition(ray, frames)) {
    Ray up_to_surface = ray;
    up_to_surface.t_max = std::min(ray.t_max, surface.hit.t);
    for (const Meeting& boundary : boundaries_along(scene, up_to_surface, surface.frames))
      meetings.add(boundary.is_boundary ? boundary : Meeting{boundary.frames, surface.hit, false});
  }
  std::stable_sort(meetings.begin(), meetings.end(),
                   [](const Meeting& a, const Meeting& b) { return a.hit.t < b.hit.t; });
  return meetings;
}

namespace {

constexpr int kMostSurfaces = 64;

FrameSet frames_in(const Glow& glow, const Scene& scene, const Ray& ray, FrameSet frames, int surfaces) {
  FrameSet inside;
  for (const Meeting& meeting : meetings_along(scene, ray, frames)) {
    const auto is_there = [&](int medium) { return medium == glow.medium; };
    if (meeting.is_boundary) {
      if (is_there(BoundaryPoint(*scene.boundaries, meeting.hit, ray.direction).medium_beyond(-ray.direction)))
        inside |= meeting.frames;
      continue;
    }
    if (meeting.hit.missed()) {
      if (!glow.is_parted) inside |= meeting.frames;
      continue;
    }
    const SurfacePoint point = scene.surface_point(meeting.hit, ray.direction);
    if (const MediumInterface* sides = scene.interface_at(meeting.hit.shape); sides != nullptr) {
      if (is_there(sides->medium_towards(dot(ray.direction, point.ng) < 0))) inside |= meeting.frames;
    } else if (surfaces < kMostSurfaces) {
      inside |= frames_in(glow, scene, point.spawn(ray.direction), meeting.frames, surfaces + 1);
    }
  }
  return inside;
}

}  // namespace

FrameSet frames_in(const Glow& glow, const Scene& scene, const Ray& ray, FrameSet frames) {
  return frames_in(glow, scene, ray, frames, 0);
}

}  // namespace dspm
