#include "dspm/lang/shutter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "dspm/base/params/params.h"
#include "dspm/base/system/readable.h"

namespace dspm {
namespace {

constexpr const char* kOpen = "shutteropen";
constexpr const char* kClose = "shutterclose";
constexpr double kLongest = 1000;  // frames

bool blurs(const PluginUse& use) { return use.blurs && use.params.is_keyed(); }
bool blurs(const LightScale& scale) { return scale.params.is_keyed(); }
bool blurs(const TextureUse& use) { return use.params.is_keyed() || use.world_from_texture.is_keyed(); }
bool blurs(const MediumUse& use) { return use.params.is_keyed() || use.world_from_medium.is_keyed(); }
bool blurs(const LightUse& use) { return use.blurs && (use.params.is_keyed() || use.world_from_light.is_keyed()); }
bool blurs(const ShapeUse& use) { return use.blurs && (use.params.is_keyed() || use.world_from_object.is_keyed()); }
bool blurs(const ObjectUse& use) { return use.blurs && use.world_from_instance.is_keyed(); }
bool blurs(const CameraUse& use) { return use.params.is_keyed() || use.camera_from_world.is_keyed(); }

template <class Uses>
std::size_t count_blurred(const Uses& uses) {
  return static_cast<std::size_t>(std::count_if(uses.begin(), uses.end(), [](const auto& use) { return blurs(use); }));
}

struct Counts {
  std::size_t cameras = 0, shapes = 0, lights = 0, materials = 0, textures = 0, media = 0;

  void add(const Variation& variation) {
    cameras += variation.camera && blurs(*variation.camera) ? 1 : 0;
    lights +=
        count_blurred(variation.lights) + count_blurred(variation.light_sources) + count_blurred(variation.area_lights);
    materials += count_blurred(variation.materials), textures += count_blurred(variation.textures);
    media += count_blurred(variation.media);
  }
};

/// Returns the number if the camera gives it; reports one that is out of range, or has keys.
std::optional<double> number_of(const CameraUse& camera, const char* name, Diagnostics& diagnostics) {
  const Param* const param = camera.params.find(name);
  if (param == nullptr) return std::nullopt;
  if (param->key) {
    diagnostics.error(param->where, fmt::format("\"{}\" must be the same in all frames", name));
    return std::nullopt;
  }
  if (param->type != ParamType::number && param->type != ParamType::integer)
    return std::nullopt;  // the camera reports it
  const std::vector<float> values = numbers_of(*param);
  if (values.size() != 1) return std::nullopt;
  const auto value = static_cast<double>(values.front());
  if (std::abs(value) <= kLongest) return value;
  diagnostics.error(param->values_where, fmt::format("\"{}\" must lie between {} and {}", name, -kLongest, kLongest));
  return std::nullopt;
}

/// In variations, a camera may repeat the scene's shutter, not change it: frames of one iteration share its time.
void expect_same(const CameraUse& camera, const Shutter& shutter, Diagnostics& diagnostics) {
  for (const auto& [name, value] : {std::pair(kOpen, shutter.open), {kClose, shutter.close}})
    if (const auto own = number_of(camera, name, diagnostics); own && *own != value)
      diagnostics.error(camera.params.find(name)->where, "the shutter is the same for all variations");
}

}  // namespace

Shutter shutter_of(const SceneDescription& scene, Diagnostics& diagnostics) {
  const bool is_pbrt = scene.dialect == Dialect::pbrt;
  const bool has_frames = scene.frames_where.file != nullptr;
  Shutter shutter;
  if (is_pbrt && has_frames) return shutter;  // pbrt's seconds only expose the film
  if (is_pbrt) shutter.close = 1;
  if (!scene.camera) return shutter;
  const CameraUse& camera = *scene.camera;
  if (const auto open = number_of(camera, kOpen, diagnostics)) shutter.open = *open;
  if (const auto close = number_of(camera, kClose, diagnostics))
    shutter.close = *close;
  else
    shutter.close = std::max(shutter.close, shutter.open);
  if (shutter.close < shutter.open && !is_pbrt) {
    const Param* const param = camera.params.find(camera.params.find(kClose) != nullptr ? kClose : kOpen);
    diagnostics.error(param->where,
                      fmt::format("the shutter closes at {}, before it opens at {}", shutter.close, shutter.open));
  }
  for (const VariationAxis& axis : scene.axes)
    for (const Variation& variation : axis.variations)
      if (variation.camera) expect_same(*variation.camera, shutter, diagnostics);
  return shutter;
}

std::vector<std::string> what_moves(const SceneDescription& scene) {
  Counts counts;
  if (scene.camera && blurs(*scene.camera)) counts.cameras = 1;
  counts.shapes = count_blurred(scene.shapes);
  std::set<std::string> sharp;  // objects
  for (const ObjectDefinition& object : scene.objects) {
    counts.shapes += count_blurred(object.shapes);
    if (std::none_of(object.shapes.begin(), object.shapes.end(), [](const ShapeUse& use) { return use.blurs; }))
      sharp.insert(object.name);
  }
  for (const ObjectUse& use : scene.instances) counts.shapes += blurs(use) && !sharp.contains(use.name) ? 1 : 0;
  counts.lights = count_blurred(scene.lights) + count_blurred(scene.area_lights);
  counts.materials = count_blurred(scene.materials), counts.textures = count_blurred(scene.textures);
  counts.media = count_blurred(scene.media);
  for (const VariationAxis& axis : scene.axes)
    for (const Variation& variation : axis.variations) counts.add(variation);
  std::vector<std::string> all;
  if (counts.cameras > 0) all.emplace_back("the camera");
  for (const auto& [count, name] : {std::pair(counts.shapes, "shape"),
                                    {counts.lights, "light"},
                                    {counts.materials, "material"},
                                    {counts.textures, "texture"}})
    if (count > 0) all.push_back(counted(count, name));
  if (counts.media > 0) all.push_back(counts.media == 1 ? "1 medium" : fmt::format("{} media", counts.media));
  return all;
}

SceneDescription after(const SceneDescription& scene, double delay) {
  SceneDescription later = scene;
  later.frames = scene.frames.after(delay);
  return later;
}

}  // namespace dspm
