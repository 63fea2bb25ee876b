#include "dspm/session/modules/all_plugins.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "dspm/accel/accel.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/cameras/camera.h"
#include "dspm/image/film/film.h"
#include "dspm/image/film/pixel_filter.h"
#include "dspm/integrators/integrator.h"
#include "dspm/lights/light.h"
#include "dspm/lights/light_group.h"
#include "dspm/lights/photon_controls.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/relief.h"
#include "dspm/media/medium.h"
#include "dspm/shapes/cutout.h"
#include "dspm/shapes/shadow_catcher.h"
#include "dspm/shapes/shape.h"
#include "dspm/shapes/shape_caustics.h"
#include "dspm/textures/plugins.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr const char* kOwn = "dspm";

template <class AnyPlugin>
std::string origin_of(const AnyPlugin& plugin) {
  return plugin.origin.empty() ? kOwn : std::string(plugin.origin);
}

template <class AnyPlugin, class... Context>
void add(std::vector<CatalogueEntry>& entries, const PluginTable<AnyPlugin>& plugins, const Context&... context) {
  for (const AnyPlugin& plugin : plugins)
    entries.push_back({std::string(plugins.kind()), std::string(plugin.name), std::string(plugin.sentence),
                       origin_of(plugin), [&plugin, &context...] { return describe(plugin, context...); }});
}

/// Adds what dspm reads for plugins of that kind, besides what they read.
void add_common(
    std::vector<CatalogueEntry>& entries, std::string_view kind, void (*read)(ParamReader&),
    bool (*of)(std::string_view name) = [](std::string_view) { return true; }) {
  for (CatalogueEntry& entry : entries)
    if (entry.kind == kind && of(entry.name))
      entry.params = [own = std::move(entry.params), read] {
        std::vector<ParamInfo> all = own();
        Diagnostics ignored;
        ParamReader reader(all, ignored);
        read(reader);
        return all;
      };
}

}  // namespace

std::vector<CatalogueEntry> all_plugins() {
  static const TextureSet textures;
  static ImageCache images;
  static const TextureContext texture{textures, {}, images};
  static const MaterialContext material{textures};
  static const LightContext light{};
  static const CameraContext camera{};
  static const MediumContext medium{};
  static const Scene scene{};
  static const RenderSettings settings{};
  static const std::span<const PlacedShape> no_shapes;
  static const FrameSet no_frames;
  std::vector<CatalogueEntry> entries;
  add(entries, shape_plugins());
  add(entries, material_plugins(), material);
  add(entries, medium_plugins(), medium);
  add(entries, texture_plugins<Rgb>(), texture);  // float textures have the same names
  add(entries, light_plugins(), light);
  add(entries, area_light_plugins(), light);
  add(entries, camera_plugins(), camera);
  add(entries, film_plugins());
  add(entries, pixel_filter_plugins());
  add(entries, accel_plugins(), no_shapes, no_frames);
  add(entries, integrator_plugins(), scene, settings);
  add_common(entries, shape_plugins().kind(), [](ParamReader& params) {
    read_alpha(params);
    read_shape_caustics(params);
    read_shadow_catcher(params);
  });
  add_common(entries, material_plugins().kind(), [](ParamReader& params) { read_priority(params); });
  add_common(
      entries, material_plugins().kind(), [](ParamReader& params) { read_relief(params, texture); }, has_relief);
  for (const auto* lights : {&light_plugins(), &area_light_plugins()})
    add_common(entries, lights->kind(), [](ParamReader& params) {
      read_photon_controls(params);
      read_light_group(params);
    });
  return entries;
}

bool is_plugin(std::string_view kind, std::string_view name) {
  const std::vector<CatalogueEntry> entries = all_plugins();
  return std::any_of(entries.begin(), entries.end(),
                     [&](const CatalogueEntry& entry) { return entry.kind == kind && entry.name == name; });
}

std::string in_words(std::string_view kind, std::string_view name) {
  const std::string plugin = fmt::format("{} \"{}\"", kind, name);
  for (const CatalogueEntry& entry : all_plugins())
    if (entry.kind == kind && entry.name == name && entry.origin != kOwn)
      return fmt::format("{} of {}", plugin, entry.origin);
  return plugin;
}

std::string in_words(const LoadedModule& module) {
  std::string plugins;
  for (const CatalogueEntry& entry : all_plugins())
    if (entry.origin == module.name)
      plugins += fmt::format("{}{} \"{}\"", plugins.empty() ? "" : ", ", entry.kind, entry.name);
  return plugins.empty() ? module.name : fmt::format("{} of {}", plugins, module.name);
}

}  // namespace dspm
