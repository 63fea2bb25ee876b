// The state that a machine makes of a block of iterations is one term of the sum over all of them. The terms are added
// in the order of their numbers, so the bits depend neither on which machine did which, nor on how many machines there
// are.
#pragma once

#include <string>

#include "dspm/integrators/integrator.h"
#include "dspm/session/block.h"
#include "dspm/session/stage.h"

namespace dspm {

/// Returns the state that the block's iterations make of `zero`, the state before any iteration. Throws what iterations
/// throw; the state of the stage's integrator is then lost.
std::string rendered(const Block& block, Stage& stage, const std::string& zero);
/// Adds a state to the integrator's.
void add(const std::string& state, Integrator& integrator);

}  // namespace dspm
