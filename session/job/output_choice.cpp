#include "dspm/session/job/output_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>
#include <variant>

#include "dspm/base/params/only_text.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/extension.h"
#include "dspm/integrators/beside/surface_outputs.h"
#include "dspm/integrators/beside/variance_output.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/lights/light_group.h"

namespace dspm {
namespace {

constexpr const char* kAllLightGroups = "lights";  // in --aov

/// Returns the outputs that one name in --aov stands for.
std::vector<std::string> expanded(const std::string& name, const SceneDescription& description) {
  if (name == kAllLightGroups) return light_group_outputs(description);
  std::vector<std::string> parts = parts_of_output(name);
  return parts.empty() ? std::vector{name} : parts;
}

std::string way_out(const std::string& name, const std::vector<std::string>& names) {
  if (name == "cryptomatte") return "there are two, \"cryptoobject\" and \"cryptomaterial\"";
  const std::string guess = did_you_mean(name, names);
  return guess.empty() ? fmt::format("it has {}", fmt::join(names, ", ")) : guess;
}

/// Returns the names that --aov takes, given what an integrator declares.
std::vector<std::string> names_for_aov(const std::vector<OutputInfo>& declared) {
  std::vector<std::string> names, groups;
  const auto add = [&](const OutputInfo& output) {
    std::vector<std::string>& to = output.is_radiance && output.name != kVolumeOutput ? groups : names;
    const std::string whole = output.name.substr(0, output.name.find('.'));
    const std::string name = parts_of_output(whole).empty() ? output.name : whole;
    if (std::find(to.begin(), to.end(), name) == to.end()) to.push_back(name);
  };
  for (const OutputInfo& output : declared) add(output);
  for (const OutputInfo& output : surface_outputs()) add(output);
  names.push_back(kVarianceOutput);
  if (!groups.empty()) names.push_back(kAllLightGroups);
  names.insert(names.end(), groups.begin(), groups.end());
  return names;
}

}  // namespace

std::vector<std::string> outputs_of(const FilmSettings& film, const Choices& choices,
                                    const SceneDescription& description) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (name != kRadiance && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  if (film.surface_outputs)
    for (const std::string& name : gbuffer_outputs()) add(name);
  if (film.transparent) add(kAlphaOutput);
  for (const std::string& name : choices.outputs)
    for (const std::string& part : expanded(name, description)) add(part);
  return names;
}

std::vector<std::string> with_denoiser_inputs(std::vector<std::string> outputs, std::optional<Denoiser> denoiser) {
  std::vector<std::string> inputs;
  if (denoiser) inputs = {kDenoisingNormal, kDenoisingAlbedo};
  if (denoiser == Denoiser::own) inputs.insert(inputs.end(), {kDenoisingDepth, kVarianceOutput});
  for (std::string& input : inputs)
    if (std::find(outputs.begin(), outputs.end(), input) == outputs.end()) outputs.push_back(std::move(input));
  return outputs;
}

std::vector<std::string> light_group_outputs(const SceneDescription& description) {
  std::set<std::string> groups;
  const auto add = [&](const PluginUse& use) {
    if (const std::string* const group = only_text(use.params.find(kGroupParam))) groups.insert(*group);
  };
  for (const LightUse& use : description.lights) add(use);
  for (const AreaLightUse& use : description.area_lights) add(use);
  groups.erase(kOtherLights);
  std::vector<std::string> outputs = {light_group_output(kOtherLights)};
  for (const std::string& group : groups) outputs.push_back(light_group_output(group));
  return outputs;
}

void expect_room(const FilmSettings& film, const std::vector<std::string>& outputs,
                 const SceneDescription& description) {
  const std::string kind = extension_of(film.filename);
  const bool holds_alpha = film.transparent && (kind == ".png" || kind == ".webp");
  const auto lacks_room = [&](const std::string& output) { return !(holds_alpha && output == kAlphaOutput); };
  const auto found = std::find_if(outputs.begin(), outputs.end(), lacks_room);
  if (kind == ".exr" || found == outputs.end()) return;
  throw UsageError(fmt::format(
      "{} cannot hold {}: images with outputs besides radiance are .exr; -o {} gives them, and with --png, "
      "PNGs of the radiance as well{}",
      film.filename, *found, std::filesystem::path(film.filename).replace_extension(".exr").string(),
      description.film && description.film->type == "gbuffer" ? "; Film \"rgb\" has no other outputs" : ""));
}

void check_outputs(const std::vector<OutputInfo>& declared, const std::vector<std::string>& asked,
                   const std::string& integrator, Diagnostics& diagnostics) {
  std::set<std::string> channels = {"R", "G", "B"};
  for (const std::string& name : asked) {
    const auto found = std::find_if(declared.begin(), declared.end(), [&](const auto& o) { return o.name == name; });
    if (found == declared.end()) {
      diagnostics.error({}, fmt::format("integrator \"{}\" has no output \"{}\"", integrator, name),
                        way_out(name, names_for_aov(declared)));
      continue;
    }
    bool good = !found->channels.empty() && found->channels.size() <= 3;
    for (const std::string& channel : found->channels)
      good = good && !channel.empty() && channels.insert(channel).second;
    if (!good)
      diagnostics.error({}, fmt::format("output \"{}\" of integrator \"{}\" needs one to three channels of its own",
                                        name, integrator));
  }
}

}  // namespace dspm
