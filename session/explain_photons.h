// Explains what a scene's integrator learns about where photons should start, without a render, and whether a GPU can trace
// them.
#pragma once

#include <string>
#include <vector>

#include "dspm/session/frame_intervals.h"
#include "dspm/session/load.h"

namespace dspm {

/// Returns one sentence each, for --explain; none if it learns nothing. Learning is left to this call and takes about
/// as long as a few iterations; a render of these frames then knows it. Throws SceneError if the integrator cannot be
/// made.
std::vector<std::string> explain_photons(const LoadedScene& loaded, const FrameList& frames, Messages& messages);

}  // namespace dspm
