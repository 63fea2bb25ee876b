// The horse's gallop with any number of frames, rendered by a process of its own.
#pragma once

#include "bench/measure/child.h"

namespace dspm {

/// Throws Skipped where the scene's meshes have not been made.
ChildReport render_gallop(int frames, const char* estimator, int iterations);

}  // namespace dspm
