#include "dspm/world/scene/scene.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace dspm {

LightChoice::LightChoice(std::vector<float> probability) : probability_(std::move(probability)) {
  std::partial_sum(probability_.begin(), probability_.end(), std::back_inserter(sums_));
}

// Sums that rounding keeps below 1 leave numbers to the last light of a probability above 0: the first that reaches the last sum.
ChosenLight LightChoice::choose(float u) const {
  if (sums_.empty()) return {0, 0};
  auto end = std::upper_bound(sums_.begin(), sums_.end(), u);
  if (end == sums_.end()) end = std::lower_bound(sums_.begin(), sums_.end(), sums_.back());
  const auto i = end - sums_.begin();
  return {static_cast<int>(i), probability_[static_cast<std::size_t>(i)]};
}

void Scene::set_palette(const std::shared_ptr<const Palette>& of_iteration) {
  palette = of_iteration;
  if (without_objects != nullptr) without_objects->set_palette(of_iteration);
}

std::int16_t Scene::nm_of(std::uint64_t seed, std::uint64_t iteration) const {
  if (!disperses) return 0;
  return palette->is_rgb() ? wavelength_of(seed, iteration) : static_cast<std::int16_t>(-palette->nm(0));
}

}  // namespace dspm
