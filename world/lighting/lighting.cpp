#include "dspm/world/lighting/lighting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/lights/emission_pattern.h"
#include "dspm/lights/light_group.h"
#include "dspm/world/lighting/medium_glow.h"
#include "dspm/world/objects/likeness.h"
#include "dspm/world/objects/param_key.h"
#include "dspm/world/objects/placement_check.h"
#include "dspm/world/objects/same_in_all_frames.h"
#include "dspm/world/objects/variations.h"

namespace dspm {
namespace {

/// A light in one frame, before it is made.
struct LightState {
  ParamList params;
  Matrix4 placement;
  int shape = -1;                  // of an emitter, into Geometry::shapes
  bool hidden = false;             // see Emitter; the same in all frames
  const PluginUse* use = nullptr;  // null: the light's own
  std::shared_ptr<const EmissionPattern> pattern = nullptr;
  std::shared_ptr<const SpectrumByNm> spectrum = nullptr;  // of what a material emits; else the parameters say it

  friend bool operator==(const LightState& a, const LightState& b) {
    return a.shape == b.shape && a.placement == b.placement && a.pattern == b.pattern && a.spectrum == b.spectrum &&
           a.params.same_values(b.params);
  }
};

class LightMaker {
 public:
  LightMaker(const SceneDescription& description, const Geometry& geometry, const Looks& looks,
             const BoundingSphere& sphere, const std::vector<WorldLight>* sooner, Diagnostics& diagnostics)
      : description_(description), geometry_(geometry), looks_(looks), sphere_(sphere), diagnostics_(diagnostics) {
    if (sooner == nullptr) return;
    for (const WorldLight& light : *sooner)
      for (std::size_t s = 0; s < light.keys.size(); ++s) known_.emplace(light.keys[s], light.states.states[s]);
  }

  /// Makes the light for the frames in which it, or what variations put in its place, is of that type.
  std::optional<WorldLight> make(const LightUse& own, const PluginUse& typed) {
    if (is_of_shapes(typed)) return std::nullopt;
    const auto* plugin = light_plugins().find(typed.type, typed.type_where, diagnostics_);
    if (!plugin) return std::nullopt;
    const std::vector<bool> present = presence(description_, own.dynamic_block);
    const std::string name = fmt::format("light \"{}\"", typed.type);
    auto places = Timeline<Matrix4>::of(
        description_.frames.count(),
        [&](FileFrame f) -> std::optional<Matrix4> {
          const LightUse& use = description_.light_of(own, f);
          if (!present[f.slot()] || use.type != typed.type) return std::nullopt;
          const Moment moment = description_.frames.moment(f, own.blurs && use.blurs);
          const Matrix4 place = own.world_from_light.at(moment);
          return &use == &own ? place : place * use.world_from_light.at(moment);
        },
        [](const Matrix4& a, const Matrix4& b) { return a == b; },
        [](const Matrix4& matrix) { return Likeness().add(matrix).number(); });
    leave_out_unplaced(places, description_.frames, name, typed.where, diagnostics_);
    const auto states = timeline([&](FileFrame f) -> std::optional<LightState> {
      if (places.at(f) < 0) return std::nullopt;
      const LightUse& use = description_.light_of(own, f);
      return LightState{light_params(description_, use, use.name, f),
                        places.states[static_cast<std::size_t>(places.at(f))], -1, false, &use};
    });
    auto light = finish(typed, name, *plugin, states);
    if (!light) return light;
    const auto& made = light->states.states;
    light->infinite = !made.empty() && made.front()->is_infinite();
    if (std::any_of(made.begin(), made.end(),
                    [&](const auto& state) { return state->is_infinite() != light->infinite; }))
      diagnostics_.error(typed.where, light->name + " can be seen in the sky in some frames, and not in others",
                         "an \"angle\" of 0.01 is as sharp as 0");
    light->is_delta = !light->infinite;
    light->short_name = own.name.empty() ? own.type : own.name;
    light->medium_interface = own.medium_interface;
    return light;
  }

  std::optional<WorldLight> make(const Emitter& emitter) {
    const AreaLightUse& use = *emitter.use;
    const auto* plugin = area_light_plugins().find(use.type, use.type_where, diagnostics_);
    if (!plugin) return std::nullopt;
    std::vector<int> shape_of(static_cast<std::size_t>(description_.frames.count()), -1);
    for (const int shape : emitter.shapes)
      geometry_.shapes()[static_cast<std::size_t>(shape)].present.for_each(
          [&](FileFrame f) { shape_of[f.slot()] = shape; });
    const auto states = timeline([&](FileFrame f) -> std::optional<LightState> {
      const int shape = shape_of[f.slot()];
      if (shape < 0) return std::nullopt;
      return emitter.of_material < 0 ? of_directive(emitter, shape, f) : of_material(emitter, shape, f);
    });
    auto light = finish(use, fmt::format("area light \"{}\"", use.type), *plugin, states);
    if (light) light->is_delta = emitter.is_hidden;
    if (light) light->short_name = use.name.empty() ? object_of(emitter) : use.name;
    if (light && !emitter.shapes.empty())
      light->medium_interface =
          geometry_.shapes()[static_cast<std::size_t>(emitter.shapes.front())].use->medium_interface;
    return light;
  }

  /// Makes the light of what a medium gives off: in the box of all shapes that it touches, or in its own.
  WorldLight make(const Media& media, const Media::Glowing& medium) {
    const Bounds3 shapes = touching(media, medium.medium);
    WorldLight light;
    light.name = fmt::format("the glow of medium \"{}\"", medium.name), light.short_name = medium.name;
    light.use = &medium.use, light.glow_of = medium.medium, light.group = kOtherLights;
    std::vector<int> state_of;  // by the medium's
    for (std::size_t s = 0; s < medium.states.states.size(); ++s) {
      const std::shared_ptr<const Medium>& state = medium.states.states[s];
      const Bounds3 box = shapes.empty() ? state->extent().value_or(Bounds3()) : part_in(shapes, state->extent());
      const bool shines = state->glows() && !box.empty();
      state_of.push_back(shines ? static_cast<int>(light.keys.size()) : -1);
      if (!shines) continue;
      ContentKey& key = light.keys.emplace_back("glow");
      key.add_bytes_of(medium.keys[s]), key.add_bytes_of(box);
      const auto known = known_.find(key);
      light.states.states.push_back(known != known_.end() ? known->second
                                                          : std::make_shared<const MediumGlow>(state, box));
      light.powers.push_back(luminance(light.states.states.back()->power()));
    }
    for (const int state : medium.states.state_of)
      light.states.state_of.push_back(state < 0 ? -1 : state_of[static_cast<std::size_t>(state)]);
    return light;
  }

 private:
  /// Returns the bounds of all shapes that the medium lies inside or outside of.
  Bounds3 touching(const Media& media, int medium) const {
    Bounds3 all;
    for (const WorldShape& shape : geometry_.shapes()) {
      const MediumInterface sides = media.interface(shape.use->medium_interface);
      if (sides.inside == sides.outside || (sides.inside != medium && sides.outside != medium)) continue;
      for (int i = 0; i < shape.placed.shape->primitive_count(); ++i) all.add(shape.placed.bounds(i));
    }
    return all;
  }
  static Bounds3 part_in(const Bounds3& box, const std::optional<Bounds3>& extent) {
    return extent ? Bounds3{max(box.low, extent->low), min(box.high, extent->high)} : box;
  }

  LightState of_directive(const Emitter& emitter, int shape, FileFrame f) const {
    const AreaLightUse& use = description_.light_of(*emitter.use, f);
    if (use.type != emitter.use->type)
      diagnostics_.error(use.type_where,
                         fmt::format("area light \"{}\" of type \"{}\" cannot be replaced by one of type \"{}\"",
                                     use.name, emitter.use->type, use.type));
    return {light_params(description_, use, use.name, f), {}, shape, emitter.is_hidden, &use};
  }
  /// Emits only where the surface has no holes: a hole has no material.
  std::optional<LightState> of_material(const Emitter& emitter, int shape, FileFrame f) const {
    const MaterialLight& light = looks_.light(emitter.of_material, f);
    if (light.is_dark() || emitter.is_hidden) return std::nullopt;
    const AreaLightUse& use = *emitter.use;
    LightState state{
        light_params(description_, use, use.name, f), {}, shape, false, nullptr, light.pattern, light.spectrum};
    const Rgb& L = light.radiance;
    state.params.params.push_back(param_of(ParamType::rgb, "L", std::vector{L.r, L.g, L.b}, use.where));
    return state;
  }

  /// "area" is what pbrt-v3, Mitsuba and Blender call it.
  bool is_of_shapes(const PluginUse& use) {
    const bool is = light_plugins().find(use.type) == nullptr &&
                    (use.type == "area" || area_light_plugins().find(use.type) != nullptr);
    if (is)
      diagnostics_.error(use.type_where,
                         fmt::format("\"{}\" is a light that shapes emit, and no LightSource", use.type),
                         "AreaLightSource \"diffuse\" makes lights of the shapes that follow it in its block");
    return is;
  }

  std::string object_of(const Emitter& emitter) const {
    if (emitter.shapes.empty()) return emitter.use->type;
    const WorldShape& shape = geometry_.shapes()[static_cast<std::size_t>(emitter.shapes.front())];
    return geometry_.object_names()[static_cast<std::size_t>(shape.placed.object)];
  }

  template <class At>
  Timeline<LightState> timeline(At&& at) const {
    return Timeline<LightState>::of(
        description_.frames.count(), at, [](const LightState& a, const LightState& b) { return a == b; },
        [](const LightState& s) { return Likeness().add(s.shape).add(s.placement).add(s.params).number(); });
  }

  std::optional<WorldLight> finish(const PluginUse& use, std::string name, const Plugin<MakeLight>& plugin,
                                   const Timeline<LightState>& states) {
    WorldLight light;
    light.name = std::move(name), light.use = &use;
    light.states.state_of = states.state_of;
    const int errors = diagnostics_.error_count();
    for (const char* each : {kPhotonsParam, kCausticsParam, kGroupParam}) {
      expect_same_in_all_frames(use, each, diagnostics_);
      for (const LightState& state : states.states)
        if (state.use != nullptr && state.use != &use) expect_same_in_all_frames(*state.use, each, diagnostics_);
    }
    for (const LightState& state : states.states) {
      LightContext context;
      context.to_world = Transform(state.placement);
      context.scene_center = sphere_.center, context.scene_radius = sphere_.radius;
      context.hidden = state.hidden;
      if (state.shape >= 0) context.shape = &geometry_.shapes()[static_cast<std::size_t>(state.shape)].placed;
      const SourceLocation& place = state.use != nullptr ? state.use->where : use.where;
      ParamReader reader(state.params, light.name, place, diagnostics_, description_.main_directory());
      const PhotonControls controls = read_photon_controls(reader);
      const auto group = read_light_group(reader);
      if (light.states.states.empty()) light.controls = controls, light.group = group;
      if (group != light.group || controls.photons != light.controls.photons ||
          controls.caustics != light.controls.caustics)
        diagnostics_.error(place,
                           "\"photons\", \"caustics\" and \"group\" must be those of the light that it replaces");
      light.keys.push_back(key_of(plugin, state));
      const auto known = state.shape < 0 ? known_.find(light.keys.back()) : known_.end();
      light.states.states.push_back(known != known_.end() ? known->second : made(reader, context, plugin, state));
      if (diagnostics_.error_count() > errors) return std::nullopt;
      light.powers.push_back(luminance(light.states.states.back()->power()));
    }
    return light;
  }

  static std::shared_ptr<const Light> made(ParamReader& reader, const LightContext& context,
                                           const Plugin<MakeLight>& plugin, const LightState& state) {
    std::unique_ptr<Light> light =
        state.pattern ? make_diffuse_area(reader, context, state.pattern) : plugin.make(reader, context);
    if (light != nullptr) light->set_spectrum(state.spectrum ? state.spectrum : reader.illuminant());
    return light;
  }

  ContentKey key_of(const Plugin<MakeLight>& plugin, const LightState& state) const {
    ContentKey key(plugin.name);
    add(key, state.params);
    key.add_bytes_of(state.placement), key.add_bytes_of(sphere_);
    return key;
  }

  const SceneDescription& description_;
  const Geometry& geometry_;
  const Looks& looks_;
  BoundingSphere sphere_;
  std::map<ContentKey, std::shared_ptr<const Light>> known_;
  Diagnostics& diagnostics_;
};

/// Groups over all frames of the file, so that a frame's photons do not depend on which others are rendered. States
/// after the first `base` do not change how these are grouped.
std::vector<std::vector<int>> group_alike(const std::vector<std::shared_ptr<const Light>>& states, int base) {
  std::vector<std::vector<int>> groups;
  const auto at = [&](int s) -> const Light& { return *states[static_cast<std::size_t>(s)]; };
  const auto join = [&](int state) {
    for (std::vector<int>& group : groups) {
      if (at(state).starts_like(at(group.front()))) return group.push_back(state);
      if (state < base &&
          std::all_of(group.begin(), group.end(), [&](int s) { return at(s).starts_like(at(state)); })) {
        group.insert(group.begin(), state);
        return;
      }
    }
    groups.push_back({state});
  };
  for (int s = 0; s < static_cast<int>(states.size()); ++s) join(s);
  return groups;
}

/// Returns the mean power over the first `frames` frames.
float mean_power(const WorldLight& light, int frames) {
  double sum = 0;
  for (FileFrame f(0); f.index() < frames; ++f) sum += light.power(f);
  return static_cast<float>(sum / static_cast<double>(frames));
}

std::optional<LightBounds> bounds_of(const WorldLight& light, int states) {
  std::optional<LightBounds> all;
  for (int s = 0; s < states; ++s) {
    const auto bounds = light.states.states[static_cast<std::size_t>(s)]->bounds();
    if (!bounds) return std::nullopt;
    if (all)
      all->add(*bounds);
    else
      all = bounds;
  }
  return all;
}

/// Variations may dim lights that come with geometry files, so their names are checked once these have been read.
void refuse_unknown_replacements(const SceneDescription& description, const Geometry& geometry,
                                 Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const LightUse& use : description.lights) names.push_back(use.name);
  for (const AreaLightUse& use : description.area_lights) names.push_back(use.name);
  for (const Emitter& emitter : geometry.emitters()) names.push_back(emitter.use->name);
  std::erase(names, "");
  for (const VariationAxis& axis : description.axes)
    for (const Variation& variation : axis.variations)
      for (const LightScale& scale : variation.lights)
        if (std::find(names.begin(), names.end(), scale.light) == names.end())
          diagnostics.error(scale.where,
                            fmt::format("neither the scene nor its geometry files have a light \"{}\"", scale.light),
                            did_you_mean(scale.light, names));
}

/// Returns the first use of each type of the light, and of what variations put in its place.
std::vector<const PluginUse*> types_of(const SceneDescription& description, const LightUse& own) {
  std::vector<const PluginUse*> types{&own};
  if (own.name.empty()) return types;
  for (const VariationAxis& axis : description.axes)
    for (const Variation& variation : axis.variations)
      for (const LightUse& use : variation.light_sources)
        if (use.name == own.name &&
            std::none_of(types.begin(), types.end(), [&](const PluginUse* known) { return known->type == use.type; }))
          types.push_back(&use);
  return types;
}

constexpr float kLeastShare = 0x1p-20f;  // a random number of 24 bits chooses it

/// Sets each light's probability to its share of the mean power. Reports lights that the "photons" of others leave less
/// than kLeastShare.
void share_out(std::vector<WorldLight>& lights, int base, Diagnostics& diagnostics) {
  double total = 0, all_photons = 0;
  const auto weight = [](const WorldLight& light) {
    return static_cast<double>(light.probability) * static_cast<double>(light.controls.photons);
  };
  for (WorldLight& light : lights) {
    light.probability = mean_power(light, base);
    if (light.probability < 0)
      diagnostics.error(light.use->where, fmt::format("the power of {} is negative", light.name));
    if (!std::isfinite(light.probability))
      diagnostics.error(light.use->where, fmt::format("the power of {} is not finite", light.name),
                        "make it darker, or the scene smaller");
    total += static_cast<double>(light.probability), all_photons += weight(light);
  }
  for (WorldLight& light : lights) {
    const auto of_photons = all_photons > 0 ? static_cast<float>(weight(light) / all_photons) : 0;
    light.probability = total > 0 ? static_cast<float>(static_cast<double>(light.probability) / total) : 0;
    if (of_photons < kLeastShare && light.probability >= kLeastShare)
      diagnostics.error(
          light.use->where,
          fmt::format("the lights' \"photons\" leave {} less than one photon path in a million", light.name),
          fmt::format("by power it would have {:.2g}%", 100 * light.probability));
  }
}

}  // namespace

std::vector<WorldLight> make_lights(const SceneDescription& description, const Geometry& geometry, const Looks& looks,
                                    const Media& media, const BoundingSphere& sphere,
                                    const std::vector<WorldLight>* sooner, Diagnostics& diagnostics) {
  LightMaker maker(description, geometry, looks, sphere, sooner, diagnostics);
  std::vector<WorldLight> lights;
  // One that cannot be made leaves an empty slot, so that emitters keep their numbers; its error stops the scene.
  for (const LightUse& own : description.lights)
    for (const PluginUse* typed : types_of(description, own))
      lights.push_back(maker.make(own, *typed).value_or(WorldLight{}));
  for (const Emitter& emitter : geometry.emitters()) lights.push_back(maker.make(emitter).value_or(WorldLight{}));
  if (diagnostics.error_count() == 0)
    for (const Media::Glowing& medium : media.glowing()) lights.push_back(maker.make(media, medium));
  refuse_unknown_replacements(description, geometry, diagnostics);
  if (diagnostics.error_count() > 0) return lights;
  const int base = description.frames.base().count();
  share_out(lights, base, diagnostics);
  for (WorldLight& light : lights) {
    const int states = light.states.states_of_first(base);
    light.alike = group_alike(light.states.states, states), light.bounds = bounds_of(light, states);
  }
  return lights;
}

std::vector<SceneLight::Alike> alike_in(const WorldLight& light, const std::vector<FileFrame>& frames) {
  std::vector<SceneLight::Alike> all;
  for (const std::vector<int>& group : light.alike) {
    const auto state_of = [&](int s) { return light.states.states[static_cast<std::size_t>(s)]; };
    SceneLight::Alike alike{state_of(group.front()), {}, {}};
    bool by_place = false;
    for (const int s : group) {
      const FrameSet set = frames_in_state(light.states, s, frames);
      if (set.empty()) continue;
      alike.states.push_back({set, state_of(s)});
      const auto ratio = state_of(s)->ratio_to(*alike.first);
      by_place |= !ratio;
      alike.factors.push_back({set, Palette::rgb().carried(ratio.value_or(Rgb()))});
    }
    if (by_place) alike.factors.clear();
    if (!alike.states.empty()) all.push_back(std::move(alike));
  }
  return all;
}

}  // namespace dspm
