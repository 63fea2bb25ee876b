// Learns where photon paths should start, from pilot paths and from what the camera finds of them.
#pragma once

#include "dspm/integrators/guiding/pilot_paths.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Learns from a scene whose frames stand for the file. The guides are off if they would not pay. The result depends on
/// the seed and on the size of the full image, but neither on the crop nor on how many photons the run traces.
EmissionGuides learn_emission(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
                              const HitPointSettings& hit_point, PilotPaths& pilot);

/// Learns nothing, but counts the paths that are found if they start by power.
void count_found(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
                 const HitPointSettings& hit_point, PilotPaths& pilot);

}  // namespace dspm
