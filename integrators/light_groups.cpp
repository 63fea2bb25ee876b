#include "dspm/integrators/light_groups.h"

#include <fmt/format.h>

#include <algorithm>

namespace dspm {

std::vector<OutputInfo> light_group_outputs(const Scene& scene) {
  std::vector<OutputInfo> outputs;
  for (const std::string& group : scene.light_groups) {
    OutputInfo& output = outputs.emplace_back();
    output.name = light_group_output(group);
    for (const char* colour : {"R", "G", "B"}) output.channels.push_back(fmt::format("{}.{}", output.name, colour));
    output.sentence = fmt::format("radiance that lights of the group \"{}\" bring", group);
    output.is_radiance = true;
  }
  return outputs;
}

LightGroups::LightGroups(const Scene& scene, const std::vector<std::string>& asked_outputs) {
  std::vector<int> of_group;
  for (const OutputInfo& output : light_group_outputs(scene)) {
    const bool asked = std::find(asked_outputs.begin(), asked_outputs.end(), output.name) != asked_outputs.end();
    of_group.push_back(asked ? count() : kNone);
    if (asked) outputs_.push_back(output.name);
  }
  for (const SceneLight& light : scene.lights)
    of_light_.push_back(of_group.empty() ? kNone : of_group[static_cast<std::size_t>(light.group)]);
}

int LightGroups::of_output(const std::string& name) const {
  const auto found = std::find(outputs_.begin(), outputs_.end(), name);
  return found == outputs_.end() ? kNone : static_cast<int>(found - outputs_.begin());
}

}  // namespace dspm
