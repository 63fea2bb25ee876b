// An interval in which frames were given up: its integrator goes on as it began, with another frame in their places, and
// nobody sees these.
#pragma once

#include <memory>

#include "dspm/integrators/integrator.h"
#include "dspm/math/frames.h"

namespace dspm {

/// Whose frames are those of the integrator's `frames` that were not given up. It iterates with the scene of all.
std::unique_ptr<Integrator> without_given_up(std::unique_ptr<Integrator> integrator, int frames, FrameSet given_up);

}  // namespace dspm
