// What a run learns of where photons start and of how light is found, once for all intervals of a file's frames.
#pragma once

#include <memory>

#include "dspm/base/params/params.h"
#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Reads "emission", which says whether to learn.
bool read_emission(ParamReader& params);

/// Returns what is learned for the settings that matter to it, and remembers it for this run. `photons` is the number
/// of paths of an iteration, which decides how light is found. If it `may_choose`, it also learns how much of the light
/// photons bring; without `guided` there is no guide. Nothing is learned if render.file is null. The caller compares
/// bytes_while_learning with render.memory.
std::shared_ptr<const LearnedEmission> emission_of_file(const Scene& scene, const RenderSettings& render,
                                                        const PhotonSettings& photon, const HitPointSettings& hit_point,
                                                        int photons, bool guided, Statistics& statistics,
                                                        bool may_choose = false);

}  // namespace dspm
