#include "dspm/world/media_in_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/world/cameras.h"

namespace dspm {

namespace {

bool parts(const Media& media, int use) {
  const MediumInterface sides = media.interface(use);
  return sides.inside != sides.outside;
}

bool is_far(const Scene& scene, const SceneLight& light) {
  if (light.states.states.empty()) return false;
  const Light& state = *light.states.states.front().object;
  const auto lit = state.illuminate(scene.center, {0.5f, 0.5f});
  return state.is_infinite() || (lit && !std::isfinite(lit->distance));
}

/// Returns whether any shape is a border of the medium.
bool is_parted(const Scene& scene, int medium) {
  const auto is_side = [&](const MediumInterface& sides) { return sides.inside == medium || sides.outside == medium; };
  return std::any_of(scene.interface_of.begin(), scene.interface_of.end(),
                     [&](int of) { return of >= 0 && is_side(scene.interfaces[static_cast<std::size_t>(of)]); }) ||
         (scene.boundaries != nullptr && std::ranges::any_of(scene.boundaries->interfaces, is_side));
}

bool is_endless(const Scene& scene, int medium) {
  if (medium == kNoMedium) return false;
  const auto& groups = scene.media[static_cast<std::size_t>(medium)].majorants.states;
  return std::any_of(groups.begin(), groups.end(), [](const auto& group) { return group.object->is_everywhere(); });
}

}  // namespace

std::vector<const WorldShape*> boundary_shapes(const Media& media, const Geometry& geometry,
                                               const std::vector<FileFrame>& frames) {
  std::vector<const WorldShape*> boundaries;
  for (const WorldShape& shape : geometry.shapes())
    if (!shape.nowhere && parts(media, shape.use->medium_interface) && !shape.only_parts.among(frames).empty())
      boundaries.push_back(&shape);
  return boundaries;
}

void add_media(Scene& scene, const Media& media, const Geometry& geometry, const std::vector<const WorldShape*>& there,
               const std::function<std::unique_ptr<Accel>(std::span<const PlacedShape>)>& make_accel) {
  scene.media = media.in(scene.file_frames);
  if (scene.media.empty()) return;
  scene.interfaces = media.interfaces();
  for (const WorldShape* shape : there) {
    const int use = shape->use->medium_interface;
    scene.interface_of.push_back(parts(media, use) ? use : -1);
  }
  auto boundaries = std::make_unique<MediumBoundaries>();
  for (const WorldShape* shape : boundary_shapes(media, geometry, scene.file_frames)) {
    PlacedShape& placed = boundaries->shapes.emplace_back(shape->placed);
    placed.frames = shape->only_parts.among(scene.file_frames), placed.cutout = nullptr;
    boundaries->interfaces.push_back(media.interface(shape->use->medium_interface));
  }
  if (boundaries->shapes.empty()) return;
  boundaries->accel = make_accel(boundaries->shapes);
  scene.boundaries = std::move(boundaries);
}

void add_media_of_lights(Scene& scene, const std::vector<WorldLight>& lights, const Media& media) {
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    SceneLight& light = scene.lights[i];
    const int glowing = lights[i].glow_of;
    if (scene.media.empty()) {
      light.is_drowned = glowing != kNoMedium;
      continue;
    }
    if (glowing != kNoMedium) {
      light.glow = {glowing, is_parted(scene, glowing)}, light.media = {glowing, glowing};
      scene.media[static_cast<std::size_t>(glowing)].light = static_cast<int>(i);
      continue;
    }
    const MediumInterface around = media.interface(lights[i].medium_interface);
    const bool far = is_far(scene, light);
    light.is_drowned = far && is_endless(scene, around.outside);
    if (!far) light.media = around;
  }
}

void add_media_around_camera(Scene& scene, const SceneDescription& description, const Media& media) {
  if (scene.media.empty()) return;
  if (scene.around_camera.empty()) scene.around_camera.push_back({scene.frames(), {}});
  std::map<Inside, FrameSet> places;
  for (const Scene::AroundCamera& around : scene.around_camera)
    around.frames.for_each([&](Frame f) {
      Inside inside = around.inside;
      const FileFrame frame = scene.file_frames[static_cast<std::size_t>(f)];
      inside.medium = media.interface(camera_use(description, frame).medium_interface).outside;
      places[inside] |= FrameSet::single(f);
    });
  scene.around_camera.clear();
  for (const auto& [inside, frames] : places) scene.around_camera.push_back({frames, inside});
}

}  // namespace dspm
