// Learns where photon paths should start, from pilot paths and from what the camera finds of them.
#pragma once

#include "dspm/integrators/file_sample.h"
#include "dspm/integrators/hit_point.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photon.h"
#include "dspm/params/params.h"
#include "dspm/scene/scene.h"

namespace dspm {

/// What learning took, and the paths of a round of which a hit point finds a photon.
struct PilotPaths {
  int rounds = 0;
  std::uint64_t of_a_round = 0, found_first = 0, found_last = 0;  // the first round does without a guide
  std::size_t bytes = 0;                                          // at most
};

/// Reads "emission": whether to learn.
bool read_emission(ParamReader& params);

/// Of a scene whose frames stand for the file. `photons`: paths of an iteration. The guide is off if it would not pay.
/// It depends on the seed and on the size of the full image, but not on the crop.
EmissionGuide learn_emission(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
                             const HitPointSettings& hit_point, int photons, PilotPaths& pilot);

/// By the settings that matter to it, remembered for this run; no guide if `guided` is false. Nothing is learned if
/// render.file is null. Throws NotEnoughMemory if learning takes more than render.memory.
std::shared_ptr<const LearnedEmission> emission_of_file(const Scene& scene, const RenderSettings& render,
                                                        const PhotonSettings& photon, const HitPointSettings& hit_point,
                                                        int photons, bool guided, Statistics& statistics);

}  // namespace dspm
