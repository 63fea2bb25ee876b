// Chooses which integrator renders a scene, and with which parameters: dspm's rules for pbrt's names.
#pragma once

#include "dspm/base/params/params.h"
#include "dspm/integrators/integrator.h"
#include "dspm/lang/description.h"
#include "dspm/session/job/choices.h"

namespace dspm {

struct IntegratorChoice {
  const IntegratorPlugin* plugin = nullptr;  // null: after an error
  ParamList params;
  SourceLocation where;
};

/// Returns the command line's integrator, else the scene's, else dsppm for .dsc and path for .pbrt. If it replaces the
/// scene's integrator, parameters that it does not know are left out. `own` is a variation's integrator, which replaces
/// the scene's; it may be null.
IntegratorChoice choose_integrator(const SceneDescription& description, const Choices& choices,
                                   Diagnostics& diagnostics, const PluginUse* own = nullptr);

/// Returns the integrator that renders in place of one that pbrt has and dspm does not, unless a module has one of that
/// name; empty if there is none. "vcm" stands in without merging, as bidirectional path tracing.
std::string_view stand_in_for(std::string_view name);

/// Returns the photons of a quick look, as many for each of its fewer pixels as `photons` are for each of the whole
/// picture.
int quick_photons(int photons);

/// Returns the parameters as the integrator describes them.
std::vector<ParamInfo> params_of(const Plugin<MakeIntegrator>& plugin);

/// Returns the plugin that the option names; throws UsageError if there is none.
template <class AnyPlugin>
const AnyPlugin* find_by_option(const PluginTable<AnyPlugin>& plugins, const char* option, const std::string& name) {
  Diagnostics diagnostics;
  const AnyPlugin* plugin = plugins.find(name, {}, diagnostics);
  if (plugin != nullptr) return plugin;
  throw UsageError(std::string("--") + option + " " + name + ": " + diagnostics.all().front().hint);
}

/// Returns the value of an integer parameter of the list, or `fallback` if it is absent.
int integer_of(const ParamList& list, std::string_view name, int fallback);

}  // namespace dspm
