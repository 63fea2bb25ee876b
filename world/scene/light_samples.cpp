#include "dspm/world/scene/light_samples.h"

#include <cstddef>

namespace dspm {

// Infinite lights share theirs half by power, of which a sky or a distant sun would take all, and half alike.
LightSamples::LightSamples(std::span<const OfLight> lights) : shares_(lights.size()), is_in_tree_(lights.size()) {
  const auto shining =
      std::count_if(lights.begin(), lights.end(), [](const OfLight& light) { return light.power > 0; });
  const bool few = static_cast<std::size_t>(shining) <= kFewLights;
  std::vector<LightTree::Lamp> lamps;
  double power = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const OfLight& light = lights[i];
    is_in_tree_[i] = !few && light.bounds && light.power > 0;
    lamps.push_back({light.bounds.value_or(LightBounds{}), is_in_tree_[i] ? light.power : 0});
    if (is_in_tree_[i] || !(light.power > 0)) continue;
    outside_.push_back(i);
    power += light.power;
  }
  tree_ = LightTree(lamps);
  const std::size_t all = tree_.empty() ? kFewLights : kFewInfinite;
  const bool each = outside_.size() <= all;
  for (const std::size_t i : outside_) {
    const double alike = 1 / static_cast<double>(outside_.size());
    shares_[i] = each ? 1 : static_cast<float>(static_cast<double>(all) / 2 * (lights[i].power / power + alike));
  }
  of_tree_ = tree_.empty() ? 0 : kSamplesOfTree;
}

}  // namespace dspm
