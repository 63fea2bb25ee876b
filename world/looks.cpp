#include "world/looks.h"

#include <fmt/format.h>

#include <algorithm>

namespace dspm {
namespace {

template <class T>
const void* address_of(const TextureSet& textures, const std::string& name) {
  return textures.find<T>(name).get();
}

Param param_of(ParamType type, std::string name, Param::Values values, const SourceLocation& where) {
  Param param;
  param.type = type, param.name = std::move(name), param.values = std::move(values);
  param.where = param.values_where = where;
  return param;
}

}  // namespace

Looks::Looks(const SceneDescription& description, Diagnostics& diagnostics)
    : frame_count_(description.frame_count), main_directory_(description.main_directory()), diagnostics_(diagnostics) {
  const bool changing =
      std::any_of(description.textures.begin(), description.textures.end(),
                  [](const TextureUse& use) { return use.params.is_keyed() || use.world_from_texture.is_keyed(); });
  textures_.resize(changing ? static_cast<std::size_t>(frame_count_) : 1);
  for (const TextureUse& use : description.textures) add_texture(use);
  for (const MaterialUse& use : description.materials) {
    const std::string name =
        use.name.empty() ? fmt::format("material \"{}\"", use.type) : fmt::format("material \"{}\"", use.name);
    of_use_.push_back(add_material(use, name));
    if (!use.name.empty() && !by_name_.emplace(use.name, of_use_.back()).second)
      diagnostics.error(use.where, fmt::format("there is a material named \"{}\" already", use.name));
  }
}

Timeline<Looks::State> Looks::states_of(const ParamList& params, const Motion* motion) const {
  const bool keyed = params.is_keyed();
  return Timeline<State>::of(
      frame_count_,
      [&](Frame f) {
        State state{keyed ? params.at(f) : params, motion ? motion->at(f) : Matrix4(), {}, f};
        for (const Param& param : params.params) {
          if (param.type != ParamType::texture) continue;
          for (const std::string& name : std::get<std::vector<std::string>>(param.values)) {
            state.textures.push_back(address_of<float>(textures_at(f), name));
            state.textures.push_back(address_of<Rgb>(textures_at(f), name));
          }
        }
        return std::optional(std::move(state));
      },
      [](const State& a, const State& b) { return a == b; });
}

void Looks::add_texture(const TextureUse& use) {
  if (use.is_spectrum)
    add_texture_of<Rgb>(use);
  else
    add_texture_of<float>(use);
}

template <class T>
void Looks::add_texture_of(const TextureUse& use) {
  const Timeline<State> states = states_of(use.params, &use.world_from_texture);
  std::vector<TexturePtr<T>> made;
  for (const State& state : states.states) {
    ParamReader reader(state.params, fmt::format("texture \"{}\"", use.type), use.where, diagnostics_, main_directory_);
    made.push_back(make_texture<T>(use.type, reader, {textures_at(state.frame), Transform(state.placement), images_}));
  }
  for (std::size_t f = 0; f < textures_.size(); ++f)
    textures_[f].add<T>(use.name, made[static_cast<std::size_t>(states.state_of[f])]);
}

int Looks::add_material(const PluginUse& use, std::string name) {
  const auto* plugin =
      find_plugin(material_plugins(), "material", use.type, use.type_where, diagnostics_, unbuilt_materials());
  // With --lenient, what is not built becomes grey.
  if (!plugin) return diagnostics_.lenient() ? find({}) : -1;
  const Timeline<State> states = states_of(use.params, nullptr);
  MaterialTimeline material;
  material.state_of = states.state_of;
  const int errors = diagnostics_.error_count();
  for (const State& state : states.states) {
    ParamReader reader(state.params, fmt::format("material \"{}\"", use.type), use.where, diagnostics_,
                       main_directory_);
    material.states.emplace_back(plugin->make(reader, MaterialContext{textures_at(state.frame)}));
    if (diagnostics_.error_count() > errors) return -1;
  }
  materials_.push_back(std::move(material));
  names_.push_back(std::move(name));
  return static_cast<int>(materials_.size()) - 1;
}

int Looks::find(const MaterialRef& ref) {
  if (ref.index >= 0) return of_use_[static_cast<std::size_t>(ref.index)];
  if (!ref.name.empty()) {
    if (const auto found = by_name_.find(ref.name); found != by_name_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [name, index] : by_name_) names.push_back(name);
    diagnostics_.error(ref.where, fmt::format("there is no material named \"{}\"", ref.name),
                       did_you_mean(ref.name, names));
    return -1;
  }
  if (default_ < 0) {
    PluginUse use;
    use.type = "diffuse";
    default_ = add_material(use, "the default material");
  }
  return default_;
}

int Looks::add(const FileMaterial& file, const SourceLocation& where) {
  const std::string key = fmt::format("{}|{}", file.texture_file.string(), file.name);
  if (const auto found = from_files_.find(key); found != from_files_.end()) return found->second;
  if (!file.texture_file.empty()) {
    TextureUse texture;
    texture.type = "imagemap", texture.name = file.name, texture.is_spectrum = true;
    texture.where = texture.type_where = where;
    texture.params.params.push_back(
        param_of(ParamType::text, "filename", std::vector{file.texture_file.string()}, where));
    add_texture(texture);
  }
  PluginUse use;
  use.type = "diffuse", use.params = file.diffuse;
  use.where = use.type_where = where;
  const int material = add_material(use, fmt::format("material \"{}\" of the file", file.name));
  from_files_.emplace(key, material);
  return material;
}

bool Looks::bounds_a_body(int material) const {
  const auto& states = materials_[static_cast<std::size_t>(material)].states;
  return std::any_of(states.begin(), states.end(), [](const auto& state) { return state->bounds_a_body(); });
}

}  // namespace dspm
