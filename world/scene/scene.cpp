#include "dspm/world/scene/scene.h"

namespace dspm {

ChosenLight LightChoice::choose(float u) const {
  float below = 0;
  ChosenLight chosen{0, 0};
  for (std::size_t i = 0; i < probability.size(); ++i) {
    if (probability[i] <= 0) continue;
    chosen = {static_cast<int>(i), probability[i]};
    below += probability[i];
    if (u < below) break;
  }
  return chosen;
}

}  // namespace dspm
