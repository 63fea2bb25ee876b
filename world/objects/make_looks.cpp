// Makes textures and materials from their recipes, after those that they name.
#include <fmt/format.h>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/math/vanishing.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/mix.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/relief.h"
#include "dspm/world/objects/looks.h"
#include "dspm/world/objects/placement_check.h"

namespace dspm {
namespace {

/// Replaces pbrt's older words for a surface that is not there.
std::string_view material_type(const PluginUse& use) {
  return use.type.empty() || use.type == "none" ? std::string_view("interface") : std::string_view(use.type);
}

}  // namespace

TextureSet Looks::known_textures(const Recipe& recipe) const {
  TextureSet textures = names_;
  const auto add_alive = [&](const auto& ingredient) {
    if (auto alive = ingredient.look->made[static_cast<std::size_t>(ingredient.state)].lock())
      textures.add(ingredient.name, std::move(alive));
  };
  for (const auto& each : recipe.numbers) add_alive(each);
  for (const auto& each : recipe.colours) add_alive(each);
  for (const auto& each : recipe.opacities)
    if (auto opacity = opacity_of(each, diagnostics_)) textures.add(each.name, std::move(opacity));
  return textures;
}

TextureSet Looks::made_textures(const Recipe& recipe, Diagnostics& diagnostics) const {
  TextureSet textures;
  for (const auto& each : recipe.numbers) textures.add(each.name, made(each, diagnostics));
  for (const auto& each : recipe.colours) textures.add(each.name, made(each, diagnostics));
  for (const auto& each : recipe.opacities)
    if (auto opacity = opacity_of(each, diagnostics)) textures.add(each.name, std::move(opacity));
  return textures;
}

MaterialSet Looks::made_materials(const Recipe& recipe, Diagnostics& diagnostics) const {
  MaterialSet materials;
  for (const auto& each : recipe.materials) materials.add(each.name, made(each, diagnostics));
  return materials;
}

template <class T>
std::shared_ptr<const T> Looks::made(const Ingredient<T>& ingredient, Diagnostics& diagnostics) const {
  const auto state = static_cast<std::size_t>(ingredient.state);
  std::weak_ptr<const T>& slot = ingredient.look->made[state];
  std::shared_ptr<const T> object = slot.lock();
  if (!object) slot = object = make_of(ingredient.look->recipes.states[state], object.get(), diagnostics);
  return object;
}

std::shared_ptr<const FloatTexture> Looks::make_of(const Recipe& recipe, const FloatTexture*,
                                                   Diagnostics& diagnostics) const {
  return make_texture_of<float>(recipe, made_textures(recipe, diagnostics), diagnostics);
}
std::shared_ptr<const RgbTexture> Looks::make_of(const Recipe& recipe, const RgbTexture*,
                                                 Diagnostics& diagnostics) const {
  return make_texture_of<Rgb>(recipe, made_textures(recipe, diagnostics), diagnostics);
}
std::shared_ptr<const Material> Looks::make_of(const Recipe& recipe, const Material*, Diagnostics& diagnostics) const {
  return make_material(recipe, made_textures(recipe, diagnostics), diagnostics);
}

template <class T>
TexturePtr<T> Looks::make_texture_of(const Recipe& recipe, const TextureSet& textures, Diagnostics& diagnostics) const {
  const PluginUse& use = *recipe.use;
  ParamReader reader(recipe.params, fmt::format("texture \"{}\"", use.type), use.where, diagnostics,
                     description_.main_directory());
  // What a scale of 0 hides has no texture.
  const bool is_placed = !vanishes(recipe.placement);
  if (is_placed && !is_sound(recipe.placement)) {
    report_singular(fmt::format("texture \"{}\"", use.type), "", use.where, diagnostics);
    return nullptr;
  }
  return make_texture<T>(use.type, reader, {textures, is_placed ? Transform(recipe.placement) : Transform(), *images_});
}

std::shared_ptr<const Material> Looks::make_material(const Recipe& recipe, const TextureSet& textures,
                                                     Diagnostics& diagnostics) const {
  const PluginUse& use = *recipe.use;
  const std::string_view type = material_type(use);
  const auto* plugin = material_plugins().find(type, use.type_where, diagnostics);
  if (!plugin && !diagnostics.lenient()) return nullptr;
  const ParamList none;  // with --lenient, unsupported materials become grey
  if (!plugin) plugin = material_plugins().find("diffuse");
  ParamReader reader(plugin->name == type ? recipe.params : none, fmt::format("material \"{}\"", type), use.where,
                     diagnostics, description_.main_directory());
  const std::optional<int> priority = read_priority(reader);
  std::shared_ptr<const Relief> relief;
  if (has_relief(plugin->name)) relief = read_relief(reader, {textures, Transform(), *images_});
  std::shared_ptr<Material> material = plugin->make(
      reader, MaterialContext{textures, made_materials(recipe, diagnostics), description_.dialect == Dialect::pbrt});
  if (material) material->set_relief(std::move(relief));
  if (material && priority) {
    material->set_priority(*priority);
    if (!material->bounds_a_body())
      diagnostics.warning(use.where,
                          fmt::format("material \"{}\" bounds no body, so its priority has no effect", type));
  }
  if (auto* mix = dynamic_cast<MixMaterial*>(material.get()))
    mix->set_opacities({opacity_of(recipe.materials[0], diagnostics), opacity_of(recipe.materials[1], diagnostics)});
  return material;
}

std::vector<FrameStates<Material>> Looks::materials_in(const std::vector<FileFrame>& frames) const {
  std::vector<FrameStates<Material>> materials;
  Diagnostics diagnostics(true);
  for (const MaterialLook& look : materials_) {
    FrameStates<Material>& states = materials.emplace_back();
    for (std::size_t s = 0; s < look.recipes.states.size(); ++s) {
      const FrameSet set = frames_in_state(look.recipes, static_cast<int>(s), frames);
      if (set.empty()) continue;
      std::shared_ptr<const Material> material = look.made[s].lock();
      const Recipe& recipe = look.recipes.states[s];
      if (!material) look.made[s] = material = make_material(recipe, made_textures(recipe, diagnostics), diagnostics);
      states.states.push_back({set, std::move(material)});
    }
  }
  diagnostics.throw_if_errors();
  return materials;
}

template TexturePtr<float> Looks::make_texture_of<float>(const Recipe&, const TextureSet&, Diagnostics&) const;
template TexturePtr<Rgb> Looks::make_texture_of<Rgb>(const Recipe&, const TextureSet&, Diagnostics&) const;

}  // namespace dspm
