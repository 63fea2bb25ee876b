#include "dspm/session/job/integrator_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "dspm/base/params/params.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

/// pbrt's integrators that converge to the same images without a medium, though with less noise or more.
struct StandIn {
  std::string_view name, by;
};
constexpr StandIn kStandIns[] = {{"volpath", "path"},    {"simplepath", "path"}, {"simplevolpath", "path"},
                                 {"randomwalk", "path"}, {"bdpt", "vcm"},        {"mlt", "vcm"},
                                 {"lightpath", "vcm"}};
constexpr std::string_view kFunction = "function";  // draws how sampling converges
constexpr std::string_view kPhotonsAlias = "photonsperiteration";

bool knows(const std::vector<ParamInfo>& described, std::string_view name) {
  if (name == kPhotonsAlias) name = "photons";
  return std::any_of(described.begin(), described.end(), [&](const ParamInfo& info) { return info.name == name; });
}

/// Integrators may mean different things by a name: "indirect" is a choice of dsppm and a switch of path.
bool takes(const std::vector<ParamInfo>& described, const Param& param) {
  const std::string_view name = param.name == kPhotonsAlias ? "photons" : std::string_view(param.name);
  return std::any_of(described.begin(), described.end(), [&](const ParamInfo& info) {
    const auto is = [&](ParamType type) { return info.type.find(word_of(type)) != info.type.npos; };
    return info.name == name && (is(param.type) || (param.type == ParamType::integer && is(ParamType::number)));
  });
}

void set_integer(ParamList& list, std::string_view name, int value) {
  std::erase_if(list.params, [&](const Param& param) { return param.name == name; });
  Param param;
  param.type = ParamType::integer;
  param.name = name;
  param.values = std::vector<int>{value};
  list.params.push_back(std::move(param));
}

/// Gives each pixel of a quick look as many photons as the scene asks for; -1 means one for each pixel anyway.
void take_photons_in_proportion(ParamList& list, const std::vector<ParamInfo>& described) {
  const auto known =
      std::find_if(described.begin(), described.end(), [](const ParamInfo& info) { return info.name == "photons"; });
  if (known == described.end()) return;
  const int usual = std::atoi(known->default_value.c_str());
  const int asked = integer_of(list, "photons", integer_of(list, kPhotonsAlias, usual));
  if (asked <= 0) return;
  std::erase_if(list.params, [](const Param& param) { return param.name == kPhotonsAlias; });
  set_integer(list, "photons", quick_photons(asked));
}

/// Returns the first interface that names a medium; null if there is none.
const MediumInterfaceUse* first_with_media(const SceneDescription& description) {
  const auto& uses = description.medium_interfaces;
  const auto first = std::find_if(uses.begin(), uses.end(), [](const MediumInterfaceUse& use) {
    return !use.inside.empty() || !use.outside.empty();
  });
  return first == uses.end() ? nullptr : &*first;
}

void refuse_media_unless_seen(const SceneDescription& description, const IntegratorPlugin& plugin,
                              Diagnostics& diagnostics) {
  const MediumInterfaceUse* const media = plugin.sees_media ? nullptr : first_with_media(description);
  if (media != nullptr)
    diagnostics.unsupported(media->where, fmt::format("integrator \"{}\" sees no media", plugin.name),
                            "dsppm, sppm, photonmap, path and vcm do; with --lenient, they are empty");
}

/// Returns the plugin for the scene's own directive, or the one that stands in for it.
const IntegratorPlugin* find_by_directive(const PluginUse& use, Diagnostics& diagnostics) {
  const std::string_view by = stand_in_for(use.type);
  const bool is_stood_in_for = !by.empty() && integrator_plugins().find(use.type) == nullptr;
  if (is_stood_in_for)
    diagnostics.note(use.where, fmt::format("integrator \"{}\" is rendered by \"{}\"{}", use.type, by,
                                            by == "vcm" ? " with \"merge\" false" : ""));
  if (use.type == kFunction) {
    diagnostics.unsupported(use.type_where, "integrator \"function\" renders no scene, so dspm does not have it",
                            "with --lenient, \"path\" renders the scene");
    return nullptr;
  }
  return integrator_plugins().find(is_stood_in_for ? by : use.type, use.type_where, diagnostics);
}

void keep_known(ParamList& list, const PluginUse& use, const Plugin<MakeIntegrator>& plugin,
                const std::vector<ParamInfo>& described, Diagnostics& diagnostics) {
  std::erase_if(list.params, [&](const Param& param) {
    if (takes(described, param)) return false;
    diagnostics.note(param.where, fmt::format("\"{}\" of integrator \"{}\" has no effect: \"{}\" renders", param.name,
                                              use.type, plugin.name));
    return true;
  });
}

/// Makes sppm without parameters what pbrt makes of it in a .pbrt file; dspm's own defaults differ.
void add_pbrt_defaults(ParamList& list, const SourceLocation& where) {
  const auto add = [&](std::string_view name, ParamType type, Param::Values value) {
    if (list.find(name) == nullptr) list.params.push_back(param_of(type, std::string(name), std::move(value), where));
  };
  if (list.find("photons") == nullptr) add(kPhotonsAlias, ParamType::integer, std::vector<int>{-1});
  add("radius", ParamType::number, std::vector<float>{1});
  add("maxdepth", ParamType::integer, std::vector<int>{5});
}

}  // namespace

std::string_view stand_in_for(std::string_view name) {
  const auto found =
      std::find_if(std::begin(kStandIns), std::end(kStandIns), [&](const StandIn& each) { return each.name == name; });
  return found == std::end(kStandIns) ? std::string_view() : found->by;
}

int quick_photons(int photons) { return std::max(1, photons / (kQuickShare * kQuickShare)); }

std::vector<ParamInfo> params_of(const Plugin<MakeIntegrator>& plugin) {
  return describe(plugin, Scene{}, RenderSettings{});
}

int integer_of(const ParamList& list, std::string_view name, int fallback) {
  const Param* param = list.find(name);
  const auto* values = param != nullptr ? std::get_if<std::vector<int>>(&param->values) : nullptr;
  return values != nullptr && values->size() == 1 ? values->front() : fallback;
}

IntegratorChoice choose_integrator(const SceneDescription& description, const Choices& choices,
                                   Diagnostics& diagnostics, const PluginUse* own) {
  IntegratorChoice choice;
  const PluginUse* const use = own != nullptr ? own : description.integrator ? &*description.integrator : nullptr;
  const auto by_name = [](const std::string& name) { return find_by_option(integrator_plugins(), "integrator", name); };
  const char* usual = description.dialect == Dialect::dsc ? "dsppm" : "path";
  if (use) choice.where = use->where;
  if (!choices.integrator.empty()) {
    choice.plugin = by_name(choices.integrator);
  } else if (use) {
    choice.plugin = find_by_directive(*use, diagnostics);
    if (choice.plugin == nullptr && diagnostics.lenient()) choice.plugin = by_name("path");
  } else {
    choice.plugin = by_name(usual);
  }
  if (choice.plugin == nullptr) return choice;

  refuse_media_unless_seen(description, *choice.plugin, diagnostics);
  const std::vector<ParamInfo> described = params_of(*choice.plugin);
  if (use) {
    choice.params = use->params;
    if (description.dialect == Dialect::pbrt && use->type == "sppm" && choice.plugin->name == use->type)
      add_pbrt_defaults(choice.params, use->where);
    if (use->type != choice.plugin->name) keep_known(choice.params, *use, *choice.plugin, described, diagnostics);
    if (choices.integrator.empty() && use->type != choice.plugin->name && choice.plugin->name == "vcm")
      choice.params.params.push_back(param_of(ParamType::boolean, "merge", std::vector<bool>{false}, use->where));
  }
  if (choices.max_depth) {
    if (!knows(described, "maxdepth"))
      throw UsageError(fmt::format("--maxdepth: \"{}\" has none", choice.plugin->name));
    set_integer(choice.params, "maxdepth", *choices.max_depth);
  }
  if (choices.photons && !knows(described, "photons")) {
    diagnostics.note({}, fmt::format("--photons has no effect: integrator \"{}\" emits none", choice.plugin->name));
  } else if (choices.photons) {
    std::erase_if(choice.params.params, [](const Param& param) { return param.name == kPhotonsAlias; });
    set_integer(choice.params, "photons", *choices.photons);
  } else if (choices.quick) {
    take_photons_in_proportion(choice.params, described);
  }
  return choice;
}

}  // namespace dspm
