// Directives after WorldBegin: materials, textures, lights, shapes.
#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/math/frames.h"
#include "dspm/base/params/numbered_files.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/scene_builder.h"

namespace dspm {
namespace {

using enum DirectiveKind;

const std::vector<std::string> kTargets{"shape", "light", "material", "medium", "texture"};

constexpr std::size_t kMostDefaults = 4096;  // bytes of values; each block and each use has a copy

std::size_t bytes_of(const ParamList& list) {
  std::size_t bytes = 0;
  for (const Param& param : list.params) {
    bytes +=
        param.name.size() + std::visit([](const auto& values) { return values.size() * sizeof(float); }, param.values);
    if (const auto* texts = std::get_if<std::vector<std::string>>(&param.values))
      for (const std::string& text : *texts) bytes += text.size();
  }
  return bytes;
}

bool gives(const ParamList& params, std::string_view name) { return params.find(name) != nullptr; }

/// Returns whether the shape may begin a run: only what can become one shape gains by it. A strand that says more than
/// its own parameters is read on its own.
bool comes_in_runs(const ShapeUse& use) {
  return use.type == "curve" && use.name.empty() && !use.params.is_keyed() &&
         std::none_of(use.params.params.begin(), use.params.params.end(), [](const Param& p) { return p.is_default; });
}

/// Removes the parameter from the list.
std::optional<Param> take(ParamList& params, std::string_view name) {
  const auto found =
      std::find_if(params.params.begin(), params.params.end(), [&](const Param& param) { return param.name == name; });
  if (found == params.params.end()) return std::nullopt;
  Param taken = std::move(*found);
  params.params.erase(found);
  return taken;
}

/// Removes `"string <name>" "<text>"` from the list.
std::optional<Argument> take_text(ParamList& params, std::string_view name, Diagnostics& diagnostics) {
  const std::optional<Param> param = take(params, name);
  if (!param) return std::nullopt;
  const auto* texts = std::get_if<std::vector<std::string>>(&param->values);
  Argument argument{{}, param->values_where};
  if (param->type == ParamType::text && !param->key && texts->size() == 1)
    argument.text = texts->front();
  else
    diagnostics.error(param->where, fmt::format("\"{}\" must be one string, the same in all frames", name));
  return argument;
}

/// Removes `"bool <name>" true` from the list, or false; reports what is neither.
std::optional<bool> take_flag(ParamList& params, std::string_view name, Diagnostics& diagnostics) {
  const std::optional<Param> param = take(params, name);
  if (!param) return std::nullopt;
  const auto* flags = std::get_if<std::vector<bool>>(&param->values);
  if (flags != nullptr && !param->key && flags->size() == 1) return flags->front();
  diagnostics.error(param->where, fmt::format("\"{}\" must be one bool, the same in all frames", name));
  return std::nullopt;
}

}  // namespace

bool SceneBuilder::apply_look(Directive& directive) {
  switch (directive.info->kind) {
    case DirectiveKind::attribute: attribute(directive); return true;
    case DirectiveKind::material: material(directive); return true;
    case DirectiveKind::make_named_material: make_named_material(directive); return true;
    case named_material: state_.material = {-1, directive.words[0].text, directive.words[0].where}; return true;
    case DirectiveKind::texture: texture(directive); return true;
    case DirectiveKind::make_named_medium: make_named_medium(directive); return true;
    case DirectiveKind::medium_interface: medium_interface(directive); return true;
    default: return false;
  }
}

bool SceneBuilder::apply_thing(Directive& directive) {
  switch (directive.info->kind) {
    case reverse_orientation: state_.reverse_orientation = !state_.reverse_orientation; return true;
    case DirectiveKind::area_light_source: area_light_source(directive); return true;
    case DirectiveKind::light_source: light_source(directive); return true;
    case DirectiveKind::shape: shape(directive); return true;
    case DirectiveKind::object_instance: object_instance(directive); return true;
    default: return false;
  }
}

void SceneBuilder::define(Places& names, const Directive& directive) {
  const Argument& name = directive.words[0];
  const auto [first, is_new] = names.emplace(name.text, name.where);
  if (!is_new)
    diagnostics_.error(name.where, fmt::format("{} \"{}\" appears twice", directive.info->name, name.text),
                       fmt::format("the first is at {}:{}", first->second.file->name, first->second.line));
}

PluginUse SceneBuilder::plugin_use(Directive& directive) {
  Argument& type = directive.words.back();
  return {std::move(type.text), std::move(directive.params), directive.where, type.where};
}

PluginUse SceneBuilder::plugin_use(Directive& directive, AttributeTarget target) const {
  PluginUse use = plugin_use(directive);
  const std::size_t given = use.params.params.size();
  const std::shared_ptr<const ParamList>& defaults = state_.attributes[static_cast<std::size_t>(target)];
  if (defaults != nullptr)
    for (const Param& param : defaults->params) {
      const auto end = use.params.params.begin() + static_cast<std::ptrdiff_t>(given);
      if (std::none_of(use.params.params.begin(), end, [&](const Param& p) { return p.name == param.name; }))
        use.params.params.push_back(param);
    }
  count_files_from(scene_.first_moment, use.params);
  if (target == AttributeTarget::shape || target == AttributeTarget::light) use.blurs = state_.blurs;
  return use;
}

std::optional<PluginUse> SceneBuilder::named_plugin_use(Directive& directive, AttributeTarget target) {
  const std::string name = directive.words[0].text;
  PluginUse use = plugin_use(directive, target);
  auto type = take_text(use.params, "type", diagnostics_);
  if (!type) {
    diagnostics_.error(directive.where, fmt::format("{} \"{}\" needs a \"string type\"", directive.info->name, name));
    return std::nullopt;
  }
  use.type = std::move(type->text);
  use.type_where = type->where;
  return use;
}

void SceneBuilder::attribute(Directive& directive) {
  const Argument& target = directive.words[0];
  const auto found = std::find(kTargets.begin(), kTargets.end(), target.text);
  if (found == kTargets.end()) {
    const std::string guess = did_you_mean(target.text, kTargets);
    diagnostics_.error(target.where, fmt::format("unknown target \"{}\" of Attribute", target.text),
                       guess.empty() ? "available: shape, light, material, medium, texture" : guess);
    return;
  }
  std::shared_ptr<const ParamList>& shared = state_.attributes[static_cast<std::size_t>(found - kTargets.begin())];
  ParamList defaults = shared != nullptr ? *shared : ParamList();
  std::erase_if(defaults.params, [&](const Param& param) { return gives(directive.params, param.name); });
  for (Param& param : directive.params.params) {
    param.is_default = true;
    defaults.params.push_back(std::move(param));
  }
  if (bytes_of(defaults) > kMostDefaults) {
    diagnostics_.error(directive.where, fmt::format("too many defaults for every {}", target.text),
                       "move long lists to the directive that needs them");
    defaults.params.clear();
  }
  shared = std::make_shared<const ParamList>(std::move(defaults));
}

void SceneBuilder::material(Directive& directive) {
  state_.material = {static_cast<int>(scene_.materials.size()), {}, directive.where};
  scene_.materials.push_back({plugin_use(directive, AttributeTarget::material), {}});
}

void SceneBuilder::make_named_material(Directive& directive) {
  Variation* const variation = variation_in_force();
  define(variation ? replaced_.materials : materials_, directive);
  std::string name = directive.words[0].text;
  if (auto use = named_plugin_use(directive, AttributeTarget::material))
    (variation ? variation->materials : scene_.materials).push_back({*std::move(use), std::move(name)});
}

void SceneBuilder::make_named_medium(Directive& directive) {
  Variation* const variation = variation_in_force();
  define(variation ? replaced_.media : media_, directive);
  std::string name = directive.words[0].text;
  Motion placement = variation ? around_variation_ : Motion();
  placement.multiply(ctm());
  if (auto use = named_plugin_use(directive, AttributeTarget::medium))
    (variation ? variation->media : scene_.media).push_back({*std::move(use), std::move(name), std::move(placement)});
}

void SceneBuilder::medium_interface(const Directive& directive) {
  state_.medium_interface = static_cast<int>(scene_.medium_interfaces.size());
  scene_.medium_interfaces.push_back({directive.words.front().text, directive.words.back().text, directive.where});
}

void SceneBuilder::texture(Directive& directive) {
  const Argument& value = directive.words[1];
  const bool is_spectrum = value.text == "spectrum";
  if (!is_spectrum && value.text != "float") {
    diagnostics_.error(value.where, fmt::format("a texture cannot be of type \"{}\"", value.text),
                       "available: float, spectrum");
    return;
  }
  Variation* const variation = variation_in_force();
  if (variation)
    define(is_spectrum ? replaced_.spectrum_textures : replaced_.float_textures, directive);
  else
    define(is_spectrum ? spectrum_textures_ : float_textures_, directive);
  std::string name = directive.words[0].text;
  Motion placement = variation ? around_variation_ : Motion();
  placement.multiply(ctm());
  (variation ? variation->textures : scene_.textures)
      .push_back({plugin_use(directive, AttributeTarget::texture), std::move(name), is_spectrum, std::move(placement)});
}

std::string SceneBuilder::take_name(ParamList& params) {
  const auto name = take_text(params, "name", diagnostics_);
  return name ? name->text : "";
}

void SceneBuilder::area_light_source(Directive& directive) {
  state_.area_light = static_cast<int>(scene_.area_lights.size());
  AreaLightUse light{plugin_use(directive, AttributeTarget::light), {}};
  light.name = take_name(light.params);
  scene_.area_lights.push_back(std::move(light));
}

void SceneBuilder::light_source(Directive& directive) {
  LightUse light{
      plugin_use(directive, AttributeTarget::light), {}, ctm(), state_.dynamic_block, state_.medium_interface};
  light.name = take_name(light.params);
  scene_.lights.push_back(std::move(light));
}

void SceneBuilder::shape(Directive& directive) {
  const std::size_t messages = diagnostics_.all().size();
  expect_still(directive);
  ShapeUse use{plugin_use(directive, AttributeTarget::shape),
               {},
               ctm(),
               state_.reverse_orientation,
               state_.material,
               state_.area_light,
               state_.dynamic_block,
               state_.medium_interface};
  use.name = take_name(use.params);
  use.blurs = take_flag(use.params, kBlurParam, diagnostics_).value_or(use.blurs);
  if (use.dynamic_block < 0 && use.params.is_keyed()) {
    const auto keyed = std::find_if(use.params.params.begin(), use.params.params.end(),
                                    [](const Param& param) { return ParamList{{param}}.is_keyed(); });
    diagnostics_.error(keyed->where, "only shapes in a Dynamic block may differ between frames",
                       "put it between DynamicBegin \"a name\" and DynamicEnd");
  }
  std::vector<ShapeUse>& shapes = blocks_.find(Block::Kind::object) ? scene_.objects.back().shapes : scene_.shapes;
  shapes.push_back(std::move(use));
  if (comes_in_runs(shapes.back()) && diagnostics_.all().size() == messages) repeatable_ = &shapes;
}

}  // namespace dspm
