// Iterations that a machine does in one go, and whose state is then one term of the sum over all of them. The terms are
// added in the order of their numbers, so the bits do not depend on which machine did which, nor on how many there are.
#pragma once

#include <algorithm>
#include <string>

#include "dspm/integrators/integrator.h"
#include "dspm/scene/scene.h"

namespace dspm {

struct Block {
  int begin = 0, end = 0;  // iterations

  /// The one that begins at an iteration: to the next multiple of `size`, but not beyond `all`; 0: endless.
  static Block from(int begin, int all, int size) {
    const int end = (begin / size + 1) * size;
    return {begin, all > 0 ? std::min(end, all) : end};
  }
};

/// The state that the block's iterations make of `zero`, which is that before any. Throws what iterations throw; the
/// integrator's own state is then lost.
std::string rendered(const Block& block, Integrator& integrator, const Scene& scene, const std::string& zero);
/// Adds a state to the integrator's.
void add(const std::string& state, Integrator& integrator);
void load(const std::string& state, Integrator& integrator);

}  // namespace dspm
