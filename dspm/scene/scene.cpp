#include "dspm/scene/scene.h"

namespace dspm {

ChosenLight Scene::choose_light(float u) const {
  float below = 0;
  ChosenLight chosen{0, 0};
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i].photon_probability <= 0) continue;
    chosen = {static_cast<int>(i), lights[i].photon_probability};
    below += lights[i].photon_probability;
    if (u < below) break;
  }
  return chosen;
}

}  // namespace dspm
