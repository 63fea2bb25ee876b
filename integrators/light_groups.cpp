#include "dspm/integrators/light_groups.h"

#include <fmt/format.h>

#include <algorithm>

namespace dspm {

namespace {

OutputInfo part_of_radiance(const std::string& name, const std::string& sentence) {
  OutputInfo output;
  output.name = name, output.sentence = sentence, output.is_radiance = true;
  for (const char* colour : {"R", "G", "B"}) output.channels.push_back(fmt::format("{}.{}", name, colour));
  return output;
}

}  // namespace

std::vector<OutputInfo> light_group_outputs(const Scene& scene) {
  std::vector<OutputInfo> outputs;
  for (const std::string& group : scene.light_groups)
    outputs.push_back(part_of_radiance(light_group_output(group),
                                       fmt::format("radiance that lights of the group \"{}\" bring", group)));
  if (!scene.media.empty())
    outputs.push_back(part_of_radiance(kVolumeOutput, "radiance that media before the first surface send"));
  return outputs;
}

LightGroups::LightGroups(const Scene& scene, const std::vector<std::string>& asked_outputs) {
  const auto group_of = [&](const std::string& output) {
    if (std::find(asked_outputs.begin(), asked_outputs.end(), output) == asked_outputs.end()) return int{kNone};
    outputs_.push_back(output);
    return count() - 1;
  };
  std::vector<int> of_group;
  for (const std::string& group : scene.light_groups) of_group.push_back(group_of(light_group_output(group)));
  if (!scene.media.empty()) of_media_ = group_of(kVolumeOutput);
  for (const SceneLight& light : scene.lights)
    of_light_.push_back(of_group.empty() ? kNone : of_group[static_cast<std::size_t>(light.group)]);
}

int LightGroups::of_output(const std::string& name) const {
  const auto found = std::find(outputs_.begin(), outputs_.end(), name);
  return found == outputs_.end() ? kNone : static_cast<int>(found - outputs_.begin());
}

}  // namespace dspm
