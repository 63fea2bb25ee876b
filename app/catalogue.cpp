#include "app/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "accel/accel.h"
#include "app/options.h"
#include "cameras/camera.h"
#include "film/film.h"
#include "film/pixel_filter.h"
#include "integrators/integrator.h"
#include "lights/light.h"
#include "materials/material.h"
#include "shapes/shape.h"
#include "textures/plugins.h"

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

std::string full_name(const CatalogueEntry& entry) { return entry.kind + ":" + entry.name; }

/// A line a parameter under a line of headings, in columns as wide as their contents.
std::string table_of(std::vector<ParamInfo> params) {
  params.insert(params.begin(), {"type", "name", "default", "", "meaning"});
  std::size_t types = 0, names = 0, defaults = 0;
  for (ParamInfo& info : params) {
    if (!info.unit.empty()) info.default_value += " " + info.unit;
    types = std::max(types, info.type.size());
    names = std::max(names, info.name.size());
    defaults = std::max(defaults, info.default_value.size());
  }
  std::string text;
  for (const ParamInfo& info : params)
    text += fmt::format("  {:<{}}  {:<{}}  {:<{}}  {}\n", info.type, types, info.name, names, info.default_value,
                        defaults, info.sentence);
  return text;
}

}  // namespace

std::vector<CatalogueEntry> all_plugins() {
  static const TextureSet textures;
  static ImageCache images;
  static const TextureContext texture{textures, {}, images};
  static const MaterialContext material{textures};
  static const LightContext light{};
  static const CameraContext camera{};
  static const Scene scene{};
  static const RenderSettings settings{};
  static const std::span<const PlacedShape> no_shapes;
  static const FrameSet no_frames;
  std::vector<CatalogueEntry> entries;
  add(entries, shape_plugins());
  add(entries, material_plugins(), material);
  add(entries, texture_plugins<Rgb>(), texture);  // float textures have the same names
  add(entries, light_plugins(), light);
  add(entries, area_light_plugins(), light);
  add(entries, camera_plugins(), camera);
  add(entries, film_plugins());
  add(entries, pixel_filter_plugins());
  add(entries, accel_plugins(), no_shapes, no_frames);
  add(entries, integrator_plugins(), scene, settings);
  return entries;
}

std::string list_plugins() {
  const std::vector<CatalogueEntry> entries = all_plugins();
  std::size_t names = 0, origins = 0;
  for (const CatalogueEntry& entry : entries)
    names = std::max(names, entry.name.size()), origins = std::max(origins, entry.origin.size());
  std::string text, kind;
  for (const CatalogueEntry& entry : entries) {
    if (entry.kind != kind) text += fmt::format("{}{}\n", text.empty() ? "" : "\n", entry.kind);
    kind = entry.kind;
    text += fmt::format("  {:<{}}  {:<{}}  {}\n", entry.name, names, entry.origin, origins, entry.sentence);
  }
  return text;
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

std::string describe_plugins(std::string_view name) {
  std::string text;
  std::vector<std::string> names;
  for (const CatalogueEntry& entry : all_plugins()) {
    names.push_back(entry.name);
    names.push_back(full_name(entry));
    if (names.back() != name && entry.name != name) continue;
    const std::vector<ParamInfo> params = entry.params();
    text += fmt::format("{}{} ({}): {}\n{}", text.empty() ? "" : "\n", names.back(), entry.origin, entry.sentence,
                        params.empty() ? "" : table_of(params));
  }
  if (!text.empty()) return text;
  const std::string guess = did_you_mean(name, names);
  throw UsageError(fmt::format("--describe {}: there is no such plugin; {}", name,
                               guess.empty() ? "dspm --list names them all as kind and name" : guess));
}

}  // namespace dspm
