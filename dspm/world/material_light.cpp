// What materials say of their shapes besides how they scatter: holes ("alpha") and light ("emission").
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "dspm/colour/rgb.h"
#include "dspm/materials/parameters.h"
#include "dspm/math/frames.h"
#include "dspm/params/params.h"
#include "dspm/world/looks.h"

namespace dspm {
namespace {

class TexturePattern final : public EmissionPattern {
 public:
  explicit TexturePattern(TexturePtr<Rgb> texture) : texture_(std::move(texture)) {}
  const Texture<Rgb>* texture() const { return texture_.get(); }

  /// Without the footprint, so that rays that hit the light and rays that are sent to it agree.
  Rgb at(const SurfacePoint& point) const override {
    Rgb c = texture_->evaluate({point.p, point.uv, point.ng, point.dpdu, point.dpdv});
    for (int i = 0; i < 3; ++i) c[i] = std::isfinite(c[i]) ? std::max(c[i], 0.f) : 0.f;
    return c;
  }

 private:
  TexturePtr<Rgb> texture_;
};

const Param* alpha_of(const Recipe& recipe) {
  return has_holes_and_light(recipe.use->type) ? recipe.params.find("alpha") : nullptr;
}

}  // namespace

/// A mix would have to choose by the point what a shape is as a whole.
void Looks::refuse_in_mix(const Definition& part, const std::string& name, Diagnostics& diagnostics) {
  for (const Definition::Use& use : part.uses) {
    if (!has_holes_and_light(use.plugin->type)) continue;
    for (const auto& [param, instead] : {std::pair("alpha", "\"alpha\""), std::pair("emission", "an AreaLightSource")})
      if (const Param* found = use.plugin->params.find(param))
        diagnostics.unsupported(found->where,
                                fmt::format("a mix does not pass on \"{}\" of material \"{}\"", param, name),
                                fmt::format("give {} to the shape; with --lenient, the mix has none", instead));
  }
}

/// The parameters have been checked when the material was made.
void Looks::add_lights(MaterialLook& look) const {
  const TexturePattern* last = nullptr;
  for (const Recipe& recipe : look.recipes.states) {
    MaterialLight& light = look.lights.emplace_back();
    if (!has_holes_and_light(recipe.use->type) || recipe.params.find("emission") == nullptr) continue;
    Diagnostics ignored(true);
    ParamReader reader(recipe.params, look.name, recipe.use->where, ignored, description_.main_directory());
    const EmissionLook emission = read_emission_look(reader);
    light.radiance = Rgb(emission.strength);
    const TexturePtr<Rgb> texture = texture_of(emission.colour, made_textures(recipe, ignored), ignored);
    if (const auto colour = texture->constant()) {
      light.radiance = *colour * emission.strength;
      continue;
    }
    const bool again = last != nullptr && last->texture() == texture.get();
    light.pattern = again ? look.lights[look.lights.size() - 2].pattern : std::make_shared<TexturePattern>(texture);
    last = static_cast<const TexturePattern*>(light.pattern.get());
  }
}

bool Looks::emits(int material) const {
  const std::vector<MaterialLight>& lights = look(material).lights;
  return std::any_of(lights.begin(), lights.end(), [](const MaterialLight& light) { return !light.is_dark(); });
}

Recipe Looks::opacity_recipe(const TextureUse& use, const Recipe& material, int of_shape, int state) const {
  Recipe recipe;
  recipe.use = &use;
  if (of_shape >= 0) {
    const Recipe& shape = numbers_[slot(of_shape)].recipes.states[slot(state)];
    recipe.params = shape.params, recipe.numbers = shape.numbers;
  }
  if (const Param* alpha = alpha_of(material)) {
    Param scale = *alpha;
    scale.name = "scale";
    if (scale.type == ParamType::texture)
      for (const auto& each : material.numbers)
        if (each.name == std::get<std::vector<std::string>>(scale.values).front()) recipe.numbers.push_back(each);
    recipe.params.params.push_back(std::move(scale));
  }
  return recipe;
}

int Looks::opacity(int material, int of_shape) {
  if (material < 0) return of_shape;
  const Timeline<Recipe>& own = look(material).recipes;
  if (std::none_of(own.states.begin(), own.states.end(), alpha_of)) return of_shape;
  const auto [known, is_new] = opacities_.try_emplace({material, of_shape});
  if (!is_new) return known->second;
  TextureUse& use = texture_uses_.emplace_back();
  use.type = "scale", use.where = use.type_where = own.states.front().use->where;
  Look<FloatTexture>& product = numbers_.emplace_back();
  product.recipes = Timeline<Recipe>::of(
      description_.frames.count(),
      [&](FileFrame f) {
        const int state = of_shape < 0 ? 0 : numbers_[slot(of_shape)].recipes.at(f);
        return std::optional(opacity_recipe(use, own.states[slot(own.at(f))], of_shape, state));
      },
      [](const Recipe& a, const Recipe& b) { return a == b; });
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
  const bool cheap = look.recipes.states[slot(state)].numbers.empty() || is_kept(look.recipes.state_of, state);
  return cheap ? this->number(number, state)->constant() : std::nullopt;
}

}  // namespace dspm
