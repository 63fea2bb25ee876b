// An iteration of an integrator, as a value: whatever differs from one iteration to the next comes in here.
#pragma once

#include <optional>

#include "dspm/world/scene/scene.h"

namespace dspm {

struct Iteration {
  int number;  // from 0; its random numbers are those of this number
  /// The scene that the integrator was made for, or its state in this iteration, with the same frames, shapes, materials
  /// and lights. It lives as long as the iteration.
  const Scene& scene;
  std::optional<double> delay = {};  // frames after their moments that it shows; none: all iterations have one scene
};

}  // namespace dspm
