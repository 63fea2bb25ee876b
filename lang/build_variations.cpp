// Axes and variations: what they may contain, and what they replace.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "dspm/base/params/params.h"
#include "dspm/lang/scene_builder.h"
#include "dspm/lang/source_text.h"

namespace dspm {
namespace {

using enum DirectiveKind;

constexpr std::size_t kNamesListed = 20, kMostAxes = 64;
constexpr std::size_t kLongestName = 100;  // bytes; file names end at 255

/// Returns whether the name is valid on every common system, and has no special characters of patterns.
bool can_be_in_file_name(std::string_view name) {
  constexpr std::string_view kRefused = "/\\:*?\"<>|";
  return !name.empty() && name != "." && name != ".." && name.size() <= kLongestName &&
         std::none_of(name.begin(), name.end(), [&](char c) {
           return static_cast<unsigned char>(c) < ' ' || c == '\x7f' || kRefused.find(c) != kRefused.npos;
         });
}

std::string listed(const std::set<std::string>& names) {
  std::string list;
  std::size_t count = 0;
  for (const std::string& name : names) {
    if (count++ == kNamesListed) return list + fmt::format(" and {} more", names.size() - kNamesListed);
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

template <class Places>
std::set<std::string> names_of_places(const Places& places) {
  std::set<std::string> names;
  for (const auto& [name, where] : places) names.insert(name);
  return names;
}

/// Reports the names that the scene has if it has nothing of that name.
void expect_name(const std::string& name, const char* thing, const std::set<std::string>& names,
                 const SourceLocation& where, const std::string& if_none, Diagnostics& diagnostics) {
  if (names.count(name) > 0) return;
  const std::string guess = did_you_mean(name, {names.begin(), names.end()});
  const std::string known = names.empty() ? if_none : "available: " + listed(names);
  diagnostics.error(where, fmt::format("the scene has no {} named \"{}\"", thing, name),
                    guess.empty() ? known : guess + " " + known);
}

bool can_replace(DirectiveKind kind) {
  switch (kind) {
    case make_named_material:
    case make_named_medium:
    case texture:
    case camera:
    case integrator:
    case light_source:
    case area_light_source:
    case dynamic_begin: return true;
    default: return moves(kind);
  }
}

bool brings_materials(const ShapeUse& shape) { return shape.type == "objmesh"; }

}  // namespace

bool SceneBuilder::apply_variation(Directive& directive) {
  const DirectiveKind kind = directive.info->kind;
  switch (kind) {
    case DirectiveKind::axis_begin: axis_begin(directive); return true;
    case DirectiveKind::axis_end: axis_end(directive); return true;
    case DirectiveKind::variation_begin: variation_begin(directive); return true;
    case DirectiveKind::variation_end: variation_end(directive); return true;
    case axis_exclude:
    case axis_only: add_rule(directive); return true;
    case light:
    case show:
    case hide: in_variation(directive); return true;
    default: break;
  }
  if (is_out_of_place(directive)) return true;
  Variation* const variation = variation_in_force();
  return variation != nullptr && (replace_lights(directive, *variation) || replace_job(directive, *variation));
}

bool SceneBuilder::is_out_of_place(const Directive& directive) {
  const DirectiveKind kind = directive.info->kind;
  const bool in_axis = blocks_.innermost_is(Block::Kind::axis),
             in_variation = blocks_.innermost_is(Block::Kind::variation);
  if (!in_axis && !in_variation) return false;
  if (in_variation && can_replace(kind)) return false;
  diagnostics_.error(directive.where,
                     fmt::format("{} is not allowed in {} ({})", directive.info->name, begin_of(blocks_.innermost()),
                                 place_of(blocks_.innermost().where, directive.where)),
                     in_axis ? "an axis contains only VariationBegin .. VariationEnd"
                             : "a variation contains MakeNamedMaterial, MakeNamedMedium, Texture, Light, LightSource, "
                               "AreaLightSource, Show, Hide, Dynamic blocks, Camera and Integrator");
  return true;
}

/// Reports an error inside another block, where axes and variations are not allowed. But an imported file, a model with
/// variants, may bring one wherever it is placed.
void SceneBuilder::expect_top_level(const Directive& directive) {
  const bool variation = directive.info->kind == DirectiveKind::variation_begin;
  const bool is_free =
      blocks_.innermost_is(Block::Kind::import) || (variation && blocks_.innermost_is(Block::Kind::axis));
  const Block* outer = is_free ? nullptr : blocks_.find_other({Block::Kind::import});
  if (outer == nullptr) return;
  diagnostics_.error(
      directive.where,
      fmt::format("{} inside {} ({})", directive.info->name, begin_of(*outer), place_of(outer->where, directive.where)),
      fmt::format("{} must come before it", end_of(outer->kind)));
}

void SceneBuilder::axis_begin(const Directive& directive) {
  const Argument& name = directive.words[0];
  expect_top_level(directive);
  if (name.text.empty()) diagnostics_.error(name.where, "an axis needs a name");
  if (scene_.axes.size() >= kMostAxes)
    throw SyntaxError(directive.where, fmt::format("there are more than {} axes", kMostAxes));
  define(axes_, directive);
  open_block(Block::Kind::axis, directive, name.text);
  scene_.axes.push_back({name.text, directive.where, {}});
}

void SceneBuilder::axis_end(const Directive& directive) {
  if (blocks_.innermost_is(Block::Kind::axis) && scene_.axes.back().variations.empty())
    diagnostics_.error(blocks_.innermost().where,
                       fmt::format("{} contains no variation", begin_of(blocks_.innermost())),
                       "define one with VariationBegin \"a name\" .. VariationEnd");
  close_block(Block::Kind::axis, directive);
}

void SceneBuilder::variation_begin(const Directive& directive) {
  const Argument& name = directive.words[0];
  expect_top_level(directive);
  if (!can_be_in_file_name(name.text))
    diagnostics_.error(
        name.where, fmt::format("\"{}\" cannot be part of a file name", name.text),
        fmt::format("images are named after variations: up to {} characters, none of / \\ : * ? \" < > |",
                    kLongestName));
  auto axis = scene_.axes.empty() ? scene_.axes.end() : scene_.axes.end() - 1;
  if (!blocks_.find(Block::Kind::axis)) {
    axis = std::find_if(scene_.axes.begin(), scene_.axes.end(), [](const auto& each) { return each.name.empty(); });
    if (axis == scene_.axes.end()) axis = scene_.axes.insert(axis, {{}, directive.where, {}});
  }
  axis_of_variation_ = static_cast<std::size_t>(axis - scene_.axes.begin());
  variations_.resize(scene_.axes.size());
  define(variations_[axis_of_variation_], directive);
  open_block(Block::Kind::variation, directive, name.text);
  around_variation_ = std::exchange(state_.ctm, {}).motion(transform_times_);
  Variation& variation = axis->variations.emplace_back();
  variation.name = name.text, variation.where = name.where;
  replaced_ = {};
}

void SceneBuilder::variation_end(const Directive& directive) { close_block(Block::Kind::variation, directive); }

Variation* SceneBuilder::variation_in_force() {
  return blocks_.innermost_is(Block::Kind::variation) ? &scene_.axes[axis_of_variation_].variations.back() : nullptr;
}

void SceneBuilder::in_variation(const Directive& directive) {
  Variation* const variation = variation_in_force();
  const Argument& name = directive.words[0];
  const bool is_light = directive.info->kind == DirectiveKind::light;
  if (variation == nullptr)
    return diagnostics_.error(directive.where, fmt::format("{} is only allowed in a variation", directive.info->name),
                              is_light ? "LightSource defines a light; VariationBegin \"a name\" begins a variation"
                                       : "VariationBegin \"a name\" begins one");
  define(is_light ? replaced_.lights : replaced_.switches, directive);
  if (is_light)
    scale_light(directive, *variation);
  else
    variation->switches.push_back({name.text, directive.info->kind == DirectiveKind::show, name.where});
}

void SceneBuilder::scale_light(const Directive& directive, Variation& variation) {
  const Argument& name = directive.words[0];
  const int errors = diagnostics_.error_count();
  ParamList unkeyed = directive.params;
  for (Param& param : unkeyed.params) param.key.reset();
  for (const Param& param : unkeyed.params) {
    const ParamList one{{param}};
    ParamReader reader(one, "Light", directive.where, diagnostics_);
    if (!(reader.number("scale", 1, "", "multiplies the light") >= 0))
      reader.error("scale", "\"scale\" of Light must not be negative");
    reader.finish();
  }
  if (unkeyed.params.empty())
    diagnostics_.error(directive.where, fmt::format("Light \"{}\" changes nothing", name.text),
                       "\"float scale\" 0.5 halves its strength");
  if (diagnostics_.error_count() == errors) variation.lights.push_back({name.text, directive.params, name.where});
}

/// Replaces the scene's LightSource or AreaLightSource.
bool SceneBuilder::replace_lights(Directive& directive, Variation& variation) {
  const bool has_area = directive.info->kind == DirectiveKind::area_light_source;
  if (!has_area && directive.info->kind != DirectiveKind::light_source) return false;
  PluginUse use = plugin_use(directive, AttributeTarget::light);
  std::string name = take_name(use.params);
  if (name.empty()) {
    diagnostics_.error(use.where,
                       fmt::format("{} in a variation replaces one of the same name",
                                   has_area ? "an AreaLightSource" : "a LightSource"),
                       "\"string name\" \"key\" replaces the light of that name");
    return true;
  }
  Places& replaced = has_area ? replaced_.area_lights : replaced_.light_sources;
  const auto [first, is_new] = replaced.emplace(name, use.where);
  if (!is_new)
    diagnostics_.error(use.where, fmt::format("{} \"{}\" appears twice", directive.info->name, name),
                       fmt::format("the first is on {}", place_of(first->second, use.where)));
  if (has_area)
    variation.area_lights.push_back({std::move(use), std::move(name)});
  else
    variation.light_sources.push_back({std::move(use), std::move(name), ctm(), state_.dynamic_block});
  return true;
}

/// Replaces the directives of the scene's block by those up to DynamicEnd.
void SceneBuilder::replace_block(const Directive& directive) {
  const Argument& name = directive.words[0];
  VariationAxis& axis = scene_.axes[axis_of_variation_];
  const auto found = dynamic_states_.find(name.text);
  std::vector<std::string> names;
  for (const auto& [each, place] : dynamic_states_) names.push_back(each);
  if (found == dynamic_states_.end())
    diagnostics_.error(name.where, fmt::format("there is no Dynamic block \"{}\" before this variation", name.text),
                       did_you_mean(name.text, names));
  else if (!found->second.is_alone)
    diagnostics_.error(name.where, fmt::format("several Dynamic blocks are named \"{}\"", name.text),
                       "a variation replaces the contents of one: give them names of their own");
  define(replaced_.blocks, directive);
  axis.variations.back().replaced_blocks.push_back(name.text);
  open_dynamic(directive, found == dynamic_states_.end() ? nullptr : &found->second);
  DynamicBlock& block = scene_.dynamic_blocks.back();
  block.axis = static_cast<int>(axis_of_variation_), block.variation = static_cast<int>(axis.variations.size()) - 1;
}

/// Replaces the scene's Camera or Integrator.
bool SceneBuilder::replace_job(Directive& directive, Variation& variation) {
  const bool is_camera = directive.info->kind == DirectiveKind::camera;
  if (!is_camera && directive.info->kind != DirectiveKind::integrator) return false;
  if (is_camera ? variation.camera.has_value() : variation.integrator.has_value())
    diagnostics_.error(directive.where, fmt::format("a second {} in this variation", directive.info->name));
  if (is_camera) {
    variation.camera = CameraUse{plugin_use(directive), place_of_replacing_camera().of_camera(),
                                 scene_.camera ? scene_.camera->medium_interface : -1};
    state_.ctm = {};
  } else {
    variation.integrator = plugin_use(directive);
  }
  return true;
}

void SceneBuilder::check_replacements() {
  const std::set<std::string> materials = names_of_places(materials_), colours = names_of_places(spectrum_textures_),
                              numbers = names_of_places(float_textures_), media = names_of_places(media_);
  std::set<std::string> lights, blocks;
  for (const LightUse& use : scene_.lights) lights.insert(use.name);
  std::set<std::string> sources = lights, areas;
  for (const AreaLightUse& use : scene_.area_lights) areas.insert(use.name);
  lights.insert(areas.begin(), areas.end());
  sources.erase(""), areas.erase("");
  const auto add_glowing = [&](const std::vector<MaterialUse>& uses) {
    for (const MaterialUse& use : uses)
      if (use.params.find("emission") != nullptr) lights.insert(use.name);
  };
  add_glowing(scene_.materials);
  for (const VariationAxis& axis : scene_.axes)
    for (const Variation& variation : axis.variations) add_glowing(variation.materials);
  lights.erase("");
  // A geometry file may bring materials, and lights that are named like them; the world, which reads it, checks these.
  const bool reads_geometry = std::any_of(scene_.shapes.begin(), scene_.shapes.end(), brings_materials) ||
                              std::any_of(scene_.objects.begin(), scene_.objects.end(), [](const ObjectDefinition& o) {
                                return std::any_of(o.shapes.begin(), o.shapes.end(), brings_materials);
                              });
  for (const DynamicBlock& block : scene_.dynamic_blocks) blocks.insert(block.name);
  const auto expect = [&](const char* thing, const std::string& name, const std::set<std::string>& names,
                          const SourceLocation& where, const std::string& if_none) {
    if (diagnostics_.error_count() < kErrorsShown) expect_name(name, thing, names, where, if_none, diagnostics_);
  };
  const auto expect_light = [&](const char* thing, const std::string& name, const std::set<std::string>& names,
                                const char* other, const std::set<std::string>& others, const SourceLocation& where) {
    if (names.count(name) == 0 && others.count(name) > 0)
      diagnostics_.error(where, fmt::format("the scene's light \"{}\" is of the directive {}", name, other),
                         fmt::format("{} \"{}\" replaces it", other, name));
    else
      expect(thing, name, names, where, fmt::format("name one with the parameter \"string name\" \"{}\"", name));
  };
  for (const VariationAxis& axis : scene_.axes)
    for (const Variation& variation : axis.variations) {
      for (const MaterialUse& use : variation.materials)
        if (!reads_geometry) expect("material", use.name, materials, use.where, "define it with MakeNamedMaterial");
      for (const MediumUse& use : variation.media)
        expect("medium", use.name, media, use.where, "define it with MakeNamedMedium");
      for (const TextureUse& use : variation.textures)
        expect(use.is_spectrum ? "spectrum texture" : "float texture", use.name, use.is_spectrum ? colours : numbers,
               use.where, "define it with Texture");
      for (const LightScale& scale : variation.lights)
        if (!reads_geometry)
          expect("light", scale.light, lights, scale.where,
                 fmt::format("name a light with the parameter \"string name\" \"{}\"", scale.light));
      for (const LightUse& use : variation.light_sources)
        expect_light("LightSource", use.name, sources, "AreaLightSource", areas, use.where);
      for (const AreaLightUse& use : variation.area_lights)
        expect_light("AreaLightSource", use.name, areas, "LightSource", sources, use.where);
      for (const BlockSwitch& each : variation.switches)
        expect("Dynamic block", each.block, blocks, each.where,
               fmt::format("define it with DynamicBegin \"{}\" .. DynamicEnd", each.block));
    }
}

}  // namespace dspm
