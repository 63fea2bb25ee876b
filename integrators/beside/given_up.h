// An interval in which frames were given up. Its integrator goes on as it began, with another frame in their places,
// whose images are not shown.
#pragma once

#include <memory>

#include "dspm/base/math/frames.h"
#include "dspm/integrators/integrator.h"

namespace dspm {

/// Returns an integrator whose frames are those of the integrator's `frames` that were not given up. It still iterates
/// with the scene of all of them.
std::unique_ptr<Integrator> without_given_up(std::unique_ptr<Integrator> integrator, int frames, FrameSet given_up);

}  // namespace dspm
