// The horse's gallop with any number of frames that divides 256 or 24, in this process or in one of its own.
#pragma once

#include "bench/measure/child.h"
#include "bench/measure/run.h"

namespace dspm {

/// Both throw Skipped if the scene's meshes have not been made.
LoadedScene load_gallop(int frames);
ChildReport render_gallop(int frames, const char* estimator, int iterations);

}  // namespace dspm
