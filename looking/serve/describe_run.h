// Describes what the page has to know of a run before there are pictures.
#pragma once

#include <span>
#include <string>

#include "dspm/integrators/output_info.h"
#include "dspm/output/view.h"
#include "dspm/session/job/job.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns JSON: the frames of the job with their moments and choices, the axes, the size, frames per second, the
/// outputs, the groups of lights, where the cameras and the scene are, the names of the images, and how PNGs show them.
/// `halvings` leads from the size that the page shows to that of the run.
std::string describe_run(const Job& job, const Scene& scene, std::span<const OutputInfo> outputs,
                         const ViewSettings& view, int number, int halvings);

}  // namespace dspm
