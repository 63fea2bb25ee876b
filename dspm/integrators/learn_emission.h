// Learns where photon paths should start, from pilot paths and from what the camera finds of them.
#pragma once

#include "dspm/integrators/file_sample.h"
#include "dspm/integrators/hit_point.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photon.h"
#include "dspm/integrators/pilot_paths.h"
#include "dspm/params/params.h"
#include "dspm/scene/scene.h"

namespace dspm {

/// Reads "emission", which says whether to learn.
bool read_emission(ParamReader& params);

/// Learns from a scene whose frames stand for the file. The guides are off if they would not pay. The result depends on
/// the seed and on the size of the full image, but neither on the crop nor on how many photons the run traces.
EmissionGuides learn_emission(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
                              const HitPointSettings& hit_point, PilotPaths& pilot);

/// Learns nothing, but counts the paths that are found if they start by power.
void count_found(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
                 const HitPointSettings& hit_point, PilotPaths& pilot);

/// Returns what is learned for the settings that matter to it, and remembers it for this run. `photons` is the number
/// of paths of an iteration, which decides how light is found. If it `may_go_on`, it also learns whether camera paths
/// go on; without `guided` there is no guide. Nothing is learned if render.file is null. The caller compares
/// bytes_while_learning with render.memory.
std::shared_ptr<const LearnedEmission> emission_of_file(const Scene& scene, const RenderSettings& render,
                                                        const PhotonSettings& photon, const HitPointSettings& hit_point,
                                                        int photons, bool guided, Statistics& statistics,
                                                        bool may_go_on = false);

}  // namespace dspm
