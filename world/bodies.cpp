#include "dspm/world/bodies.h"

#include <map>
#include <set>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/integrators/transport/body.h"

namespace dspm {

void find_bodies(Scene& scene) {
  std::set<int> priorities;
  bool absorbs = false;
  std::vector<bool> bounds;
  for (const FrameStates<Material>& material : scene.materials) {
    bounds.push_back(false);
    for (const auto& state : material.states) {
      scene.disperses |= state.object->disperses();
      if (!state.object->bounds_a_body()) continue;
      bounds.back() = true;
      priorities.insert(state.object->priority());
      absorbs |= !is_black(state.object->absorption(Palette::rgb()));
    }
  }
  scene.nests = priorities.size() > 1;
  if (scene.nests || absorbs) scene.bounds_bodies = std::move(bounds);
}

void find_bodies_around_camera(Scene& scene) {
  if (scene.bounds_bodies.empty()) return;
  std::map<Inside, FrameSet> places;
  for (Frame f = 0; f < scene.frame_count(); ++f)
    places[inside_at(scene, scene.camera_to_world[static_cast<std::size_t>(f)].point({}), f)] |= FrameSet::single(f);
  if (places.size() == 1 && places.begin()->first.is_empty()) return;
  for (const auto& [inside, frames] : places) scene.around_camera.push_back({frames, inside});
}

}  // namespace dspm
