// Collects what materials say of their shapes besides how they scatter: holes ("alpha") and light ("emission").
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/mix.h"
#include "dspm/materials/parameters.h"
#include "dspm/world/objects/looks.h"

namespace dspm {
namespace {

class TexturePattern final : public EmissionPattern {
 public:
  explicit TexturePattern(TexturePtr<Rgb> texture) : texture_(std::move(texture)) {}
  const Texture<Rgb>* texture() const { return texture_.get(); }

  Rgb at(const SurfacePoint& point) const override {
    Rgb c = texture_->evaluate(texture_point(point));
    for (int i = 0; i < 3; ++i) c[i] = std::isfinite(c[i]) ? std::max(c[i], 0.f) : 0.f;
    return c;
  }

 private:
  TexturePtr<Rgb> texture_;
};

/// The light that the parts of a mix emit, each by how much of the point it covers.
class MixedPattern final : public EmissionPattern {
 public:
  MixedPattern(std::shared_ptr<const MixMaterial> mix, std::array<MaterialLight, 2> lights)
      : mix_(std::move(mix)), lights_(std::move(lights)) {}

  Rgb at(const SurfacePoint& point) const override {
    const auto cover = mix_->cover(texture_point(point));
    Rgb sum;
    for (std::size_t i = 0; i < lights_.size(); ++i)
      if (cover[i] > 0) sum += lights_[i].at(point) * (cover[i] / (cover[0] + cover[1]));
    return sum;
  }

 private:
  std::shared_ptr<const MixMaterial> mix_;
  std::array<MaterialLight, 2> lights_;
};

const Param* alpha_of(const Recipe& recipe) {
  return has_holes_and_light(recipe.use->type) ? recipe.params.find("alpha") : nullptr;
}

}  // namespace

/// Returns the material's own light. Its parameters were checked when the material was made.
MaterialLight Looks::own_light(const MaterialLook& look, const Recipe& recipe) const {
  MaterialLight light;
  if (!has_holes_and_light(recipe.use->type) || recipe.params.find("emission") == nullptr) return light;
  Diagnostics ignored(true);
  ParamReader reader(recipe.params, look.name, recipe.use->where, ignored, description_.main_directory());
  const EmissionLook emission = read_emission_look(reader);
  light.radiance = Rgb(emission.strength);
  const TexturePtr<Rgb> texture = texture_of(emission.colour, made_textures(recipe, ignored), ignored);
  if (const auto colour = texture->constant())
    light.radiance = *colour * emission.strength, light.spectrum = emission.colour.spectrum;
  else
    light.pattern = std::make_shared<TexturePattern>(texture);
  return light;
}

/// Returns the light of a mix, whose parts have been made before it.
MaterialLight Looks::mixed_light(const MaterialLook& look, int state) const {
  std::array<MaterialLight, 2> lights;
  const std::vector<Ingredient<Material>>& parts = look.recipes.states[slot(state)].materials;
  for (std::size_t i = 0; i < parts.size(); ++i)
    lights[i] = static_cast<const MaterialLook&>(*parts[i].look).lights[slot(parts[i].state)];
  if (lights[0].is_dark() && lights[1].is_dark()) return {};
  Diagnostics ignored(true);
  auto mix = std::dynamic_pointer_cast<const MixMaterial>(made(Ingredient<Material>{{}, &look, state}, ignored));
  return {Rgb(1), std::make_shared<MixedPattern>(std::move(mix), std::move(lights))};
}

void Looks::add_lights(MaterialLook& look) const {
  for (std::size_t s = 0; s < look.recipes.states.size(); ++s) {
    const Recipe& recipe = look.recipes.states[s];
    MaterialLight light = recipe.materials.empty() ? own_light(look, recipe) : mixed_light(look, static_cast<int>(s));
    const auto* pattern = dynamic_cast<const TexturePattern*>(light.pattern.get());
    const auto* last = s > 0 ? dynamic_cast<const TexturePattern*>(look.lights.back().pattern.get()) : nullptr;
    if (pattern && last && pattern->texture() == last->texture()) light.pattern = look.lights.back().pattern;
    look.lights.push_back(std::move(light));
  }
}

bool Looks::emits(int material) const {
  const std::vector<MaterialLight>& lights = look(material).lights;
  return std::any_of(lights.begin(), lights.end(), [](const MaterialLight& light) { return !light.is_dark(); });
}

bool Looks::has_holes(const MaterialLook& look, int state) const {
  return look.has_open_parts[slot(state)] || alpha_of(look.recipes.states[slot(state)]) != nullptr;
}

TexturePtr<float> Looks::opacity_of(const Ingredient<Material>& material, Diagnostics& diagnostics) const {
  const Recipe& recipe = material.look->recipes.states[slot(material.state)];
  if (alpha_of(recipe) != nullptr) {
    ParamReader reader(recipe.params, material.name, recipe.use->where, diagnostics, description_.main_directory());
    return texture_of(read_opacity(reader), made_textures(recipe, diagnostics), diagnostics);
  }
  const std::shared_ptr<const Material> object = made(material, diagnostics);
  if (object && !object->is_seen()) return std::make_shared<ConstantTexture<float>>(0.f);
  const auto* mix = dynamic_cast<const MixMaterial*>(object.get());
  return mix != nullptr ? mix->opacity() : nullptr;
}

Recipe Looks::opacity_recipe(const TextureUse& use, const MaterialLook& material, int state, int of_shape,
                             int state_of_shape) const {
  Recipe recipe;
  recipe.use = &use;
  if (of_shape >= 0) {
    const Recipe& shape = numbers_[slot(of_shape)].recipes.states[slot(state_of_shape)];
    recipe.params = shape.params, recipe.numbers = shape.numbers;
  }
  const Recipe& own = material.recipes.states[slot(state)];
  if (const Param* alpha = alpha_of(own)) {
    Param scale = *alpha;
    scale.name = "scale";
    if (scale.type == ParamType::texture)
      for (const auto& each : own.numbers)
        if (each.name == std::get<std::vector<std::string>>(scale.values).front()) recipe.numbers.push_back(each);
    recipe.params.params.push_back(std::move(scale));
  } else if (material.has_open_parts[slot(state)]) {
    const std::string name = "the opacity of " + material.name;
    recipe.params.params.push_back(param_of(ParamType::texture, "scale", std::vector{name}, own.use->where));
    recipe.opacities.push_back({name, &material, state});
  }
  return recipe;
}

int Looks::opacity(int material, int of_shape) {
  if (material < 0) return of_shape;
  const MaterialLook& own = look(material);
  const int states = static_cast<int>(own.recipes.states.size());
  bool is_open = false;
  for (int s = 0; s < states; ++s) is_open |= has_holes(own, s);
  if (!is_open) return of_shape;
  const auto [known, is_new] = opacities_.try_emplace({material, of_shape});
  if (!is_new) return known->second;
  TextureUse& use = texture_uses_.emplace_back();
  use.type = "scale", use.where = use.type_where = own.recipes.states.front().use->where;
  Look<FloatTexture>& product = numbers_.emplace_back();
  product.recipes = Timeline<Recipe>::of(
      description_.frames.count(),
      [&](FileFrame f) {
        const int state = of_shape < 0 ? 0 : numbers_[slot(of_shape)].recipes.at(f);
        return std::optional(opacity_recipe(use, own, own.recipes.at(f), of_shape, state));
      },
      [](const Recipe& a, const Recipe& b) { return a == b; }, likeness_of);
  make_states(product, use);
  return known->second = static_cast<int>(numbers_.size()) - 1;
}

TexturePtr<float> Looks::number(int number, int state) const {
  Diagnostics diagnostics(true);
  TexturePtr<float> texture = made(Ingredient<FloatTexture>{{}, &numbers_[slot(number)], state}, diagnostics);
  diagnostics.throw_if_errors();
  return texture;
}

std::optional<float> Looks::constant(int number, int state) const {
  const Look<FloatTexture>& look = numbers_[slot(number)];
  const Recipe& recipe = look.recipes.states[slot(state)];
  const bool cheap = (recipe.numbers.empty() && recipe.opacities.empty()) || is_kept(look.recipes.state_of, state);
  return cheap ? this->number(number, state)->constant() : std::nullopt;
}

}  // namespace dspm
