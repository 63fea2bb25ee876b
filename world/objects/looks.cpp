#include "dspm/world/objects/looks.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/mix.h"
#include "dspm/world/objects/params_at.h"

namespace dspm {
namespace {

std::vector<std::string> named_textures(const ParamList& params) {
  std::vector<std::string> names;
  for (const Param& param : params.params)
    if (param.type == ParamType::texture)
      for (const std::string& name : std::get<std::vector<std::string>>(param.values)) names.push_back(name);
  return names;
}

bool names_materials(const Param& param) { return param.type == ParamType::text && param.name == "materials"; }

constexpr int kNotYet = -2, kUnderWay = -3;  // of a material that is added with those that it names
constexpr int kDeepestMix = 64;

/// A recipe before its parameters are evaluated.
struct Source {
  Definition::Use use;
  Moment moment;
  std::vector<Ingredient<FloatTexture>> numbers;
  std::vector<Ingredient<RgbTexture>> colours;
  std::vector<Ingredient<Material>> materials;

  friend bool operator==(const Source& a, const Source& b) {
    return a.use.plugin == b.use.plugin && a.moment == b.moment && a.numbers == b.numbers && a.colours == b.colours &&
           a.materials == b.materials;
  }
  std::uint64_t likeness() const {
    Likeness all;
    all.add(static_cast<const void*>(use.plugin)).add(moment.frames());
    add_ingredients(all, numbers), add_ingredients(all, colours), add_ingredients(all, materials);
    return all.number();
  }
  Recipe recipe(const FileFrames& frames) const {
    return {use.plugin,
            params_at(use.plugin->params, frames, moment),
            use.motion ? use.motion->at(moment) : Matrix4(),
            numbers,
            colours,
            materials};
  }
};

/// The most lookups of textures within one another, counted in turn: deep nesting would exhaust the stack, wide nesting
/// would never end.
constexpr int kMostLookups = 1000;
int lookups_for(const Recipe& recipe) {
  int sum = 1;
  const auto add = [&](const auto& ingredients) {
    for (const auto& each : ingredients)
      sum = std::min(kMostLookups, sum + each.look->lookups[static_cast<std::size_t>(each.state)]);
  };
  add(recipe.numbers), add(recipe.colours);
  return sum;
}

}  // namespace

Looks::Looks(const SceneDescription& description, std::shared_ptr<ImageCache> images, Diagnostics& diagnostics)
    : description_(description), diagnostics_(diagnostics), images_(std::move(images)) {
  for (const TextureUse& use : description.textures) add_texture(use);
  for (std::size_t i = 0; i < description.materials.size(); ++i) {
    const MaterialUse& use = description.materials[i];
    if (!use.name.empty() && !uses_.emplace(use.name, i).second)
      diagnostics.error(use.where, fmt::format("a material named \"{}\" exists already", use.name));
  }
  of_use_.assign(description.materials.size(), kNotYet);
  for (std::size_t i = 0; i < of_use_.size(); ++i) add_with_parts(i, 0);
}

int Looks::add_with_parts(std::size_t use_index, int depth) {
  if (of_use_[use_index] != kNotYet) return of_use_[use_index];
  const MaterialUse& use = description_.materials[use_index];
  of_use_[use_index] = kUnderWay;
  const auto add_part = [&](const std::string& name, const Param& param) {
    const auto found = uses_.find(name);
    if (found == uses_.end()) {
      std::vector<std::string> names;
      for (const auto& [known, index] : uses_) names.push_back(known);
      diagnostics_.error(param.values_where, fmt::format("there is no material named \"{}\"", name),
                         did_you_mean(name, names));
    } else if (of_use_[found->second] == kUnderWay) {
      diagnostics_.error(param.values_where, fmt::format("material \"{}\" is made of itself", name));
    } else if (depth == kDeepestMix) {
      diagnostics_.error(param.values_where, fmt::format("mixes are nested more than {} deep", kDeepestMix));
    } else {
      add_with_parts(found->second, depth + 1);
    }
  };
  for (const Definition::Use& each : definition_of(description_, use).uses)
    for (const Param& param : each.plugin->params.params)
      if (names_materials(param))
        for (const std::string& name : std::get<std::vector<std::string>>(param.values)) add_part(name, param);
  const std::string& name = use.name.empty() ? use.type : use.name;
  of_use_[use_index] = add_material(use, fmt::format("material \"{}\"", name), name);
  if (!use.name.empty()) by_name_.emplace(use.name, of_use_[use_index]);
  return of_use_[use_index];
}

template <class T>
void Looks::add_ingredients(std::vector<Ingredient<Texture<T>>>& list, const ParamList& params, FileFrame frame) const {
  for (const std::string& name : named_textures(params))
    if (const auto found = textures<T>().by_name.find(name); found != textures<T>().by_name.end())
      list.push_back({name, found->second, found->second->recipes.at(frame)});
}

void Looks::add_ingredients(std::vector<Ingredient<Material>>& list, const ParamList& params, FileFrame frame) const {
  for (const Param& param : params.params) {
    if (!names_materials(param)) continue;
    for (const std::string& name : std::get<std::vector<std::string>>(param.values))
      if (const auto found = by_name_.find(name); found != by_name_.end() && found->second >= 0)
        list.push_back({name, &look(found->second), look(found->second).recipes.at(frame)});
  }
}

Timeline<Recipe> Looks::recipes_of(const Definition& definition) const {
  const FileFrames& frames = description_.frames;
  // Compared before parameters are evaluated, as most frames repeat an earlier recipe.
  const auto sources = Timeline<Source>::of(
      frames.count(),
      [&](FileFrame f) {
        const Definition::Use& use = definition.uses[definition.use_of[frames.combination_of(f)]];
        Source source{use, use.is_keyed() ? frames.moment(f, use.plugin->blurs) : Moment(), {}, {}, {}};
        add_ingredients<float>(source.numbers, use.plugin->params, f);
        add_ingredients<Rgb>(source.colours, use.plugin->params, f);
        add_ingredients(source.materials, use.plugin->params, f);
        return std::optional(std::move(source));
      },
      [](const Source& a, const Source& b) { return a == b; }, [](const Source& source) { return source.likeness(); });
  Timeline<Recipe> recipes;
  Timeline<Recipe>::Index index;
  std::vector<int> recipe_of;
  for (const Source& source : sources.states)
    recipe_of.push_back(recipes.place(
        source.recipe(frames), index, [](const Recipe& a, const Recipe& b) { return a == b; }, likeness_of));
  for (const int source : sources.state_of) recipes.state_of.push_back(recipe_of[static_cast<std::size_t>(source)]);
  return recipes;
}

bool Looks::is_kept(const std::vector<int>& state_of, int state) const {
  return state_of.size() <= kMaxFrames ||
         std::all_of(state_of.begin(), state_of.end(), [&](int each) { return each == state; });
}

template <class T, class Make>
bool Looks::look_at(Look<T>& look, Make&& make) {
  std::set<const PluginUse*> wrong;  // reported once
  std::shared_ptr<const T> last;     // holds the pictures that the next state shows, too
  for (std::size_t s = 0; s < look.recipes.states.size(); ++s) {
    const Recipe& recipe = look.recipes.states[s];
    look.made.emplace_back();
    if (wrong.count(recipe.use) > 0) continue;
    const int errors = diagnostics_.error_count();
    std::shared_ptr<const T> made = make(recipe, known_textures(recipe));
    if (diagnostics_.error_count() > errors) wrong.insert(recipe.use);
    look.made.back() = made;
    if (is_kept(look.recipes.state_of, static_cast<int>(s))) look.kept.push_back(made);
    last = std::move(made);
  }
  return wrong.empty();
}

void Looks::add_texture(const TextureUse& own) {
  if (own.is_spectrum)
    add_texture_of<Rgb>(own);
  else
    add_texture_of<float>(own);
}

template <class T>
void Looks::add_texture_of(const TextureUse& own) {
  auto& [looks, by_name] = std::get<Textures<T>>(textures_);
  Look<Texture<T>>& look = looks.emplace_back();
  look_at_texture(look, own);
  by_name[own.name] = &look;
  names_.add<T>(own.name, std::make_shared<ConstantTexture<T>>(T(0.5f)));
}

template <class T>
void Looks::look_at_texture(Look<Texture<T>>& look, const TextureUse& own) {
  look.recipes = recipes_of(definition_of(description_, own));
  make_states(look, own);
}

template <class T>
void Looks::make_states(Look<Texture<T>>& look, const TextureUse& own) {
  for (const Recipe& recipe : look.recipes.states) look.lookups.push_back(lookups_for(recipe));
  if (*std::max_element(look.lookups.begin(), look.lookups.end()) == kMostLookups)
    diagnostics_.error(own.where,
                       fmt::format("each lookup of texture \"{}\" takes {} others or more", own.name, kMostLookups),
                       "a texture that names another one twice looks it up twice");
  look_at(look, [&](const Recipe& recipe, const TextureSet& textures) {
    return make_texture_of<T>(recipe, textures, diagnostics_);
  });
}

int Looks::add_number(std::string type, ParamList params, const SourceLocation& where, bool blurs) {
  TextureUse& use = texture_uses_.emplace_back();
  use.blurs = blurs;
  use.type = std::move(type), use.params = std::move(params), use.where = use.type_where = where;
  look_at_texture(numbers_.emplace_back(), use);
  return static_cast<int>(numbers_.size()) - 1;
}

int Looks::add_material(const MaterialUse& own, std::string name, const std::string& public_name) {
  MaterialLook look;
  look.name = std::move(name), look.own_name = own.name;
  look.recipes = recipes_of(definition_of(description_, own));
  const bool good = look_at(look, [&](const Recipe& recipe, const TextureSet& textures) {
    const auto made = make_material(recipe, textures, diagnostics_);
    look.bounds_a_body = look.bounds_a_body || (made && made->bounds_a_body());
    look.seen.push_back(!made || made->is_seen());
    const auto* mix = dynamic_cast<const MixMaterial*>(made.get());
    look.has_open_parts.push_back(mix != nullptr && mix->opacity() != nullptr);
    return made;
  });
  if (!good || look.seen.size() < look.recipes.states.size()) return -1;
  add_lights(look);
  materials_.push_back(std::move(look));
  return material_names_.add(public_name);
}

int Looks::find(const MaterialRef& ref) {
  if (ref.index >= 0) return of_use_[static_cast<std::size_t>(ref.index)];
  if (!ref.name.empty()) {
    std::vector<std::string> names;
    for (const auto* known : {&by_name_, &by_name_in_files_}) {
      if (const auto found = known->find(ref.name); found != known->end()) return found->second;
      for (const auto& [name, index] : *known) names.push_back(name);
    }
    diagnostics_.error(ref.where, fmt::format("there is no material named \"{}\"", ref.name),
                       did_you_mean(ref.name, names));
    return -1;
  }
  if (default_ < 0) {
    MaterialUse& use = material_uses_.emplace_back();
    use.type = "diffuse";
    default_ = add_material(use, "the default material", use.type);
  }
  return default_;
}

void Looks::refuse_unknown_replacements() {
  std::vector<std::string> names;
  for (const auto* known : {&by_name_, &by_name_in_files_})
    for (const auto& [name, index] : *known) names.push_back(name);
  for (const VariationAxis& axis : description_.axes)
    for (const Variation& variation : axis.variations)
      for (const MaterialUse& use : variation.materials)
        if (!by_name_.contains(use.name) && !by_name_in_files_.contains(use.name))
          diagnostics_.error(use.where,
                             fmt::format("neither the scene nor its geometry files have a material \"{}\"", use.name),
                             did_you_mean(use.name, names));
}

template void Looks::make_states<float>(Look<FloatTexture>&, const TextureUse&);

}  // namespace dspm
