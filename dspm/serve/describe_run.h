// What the page has to know of a run before there are pictures.
#pragma once

#include <span>
#include <string>

#include "dspm/integrators/output_info.h"
#include "dspm/scene/scene.h"
#include "dspm/world/job.h"

namespace dspm {

/// JSON: the frames of the job with their moments and choices, the axes, the size, frames per second, the outputs,
/// and where the cameras and the scene are.
std::string describe_run(const Job& job, const Scene& scene, std::span<const OutputInfo> outputs, int number);

}  // namespace dspm
