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

}  // namespace dspm
