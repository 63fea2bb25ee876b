// Photons traced in waves: what trace_photons.h makes of paths one by one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/integrators/waves/wave_tracer.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns what keeps photons with these settings from being traced in waves, in words that follow "because"; empty if nothing
/// does.
std::string why_not_in_waves(const Scene& scene, const PhotonSettings& settings);
/// The same for a scene that is plain.
std::string why_not_by_settings(const Scene& scene, const PhotonSettings& settings);

/// Does what trace_photons() does, for a scene and settings of which why_not_in_waves() says nothing; `tracer` has the plain
/// scene. Photons and their order are the same, bit for bit, but the traces' counts are those of the whole.
std::vector<PhotonTrace> trace_photons_in_waves(const Scene& scene, WaveTracer& tracer, const PhotonSettings& settings,
                                                std::uint64_t iteration, std::int64_t first, std::int64_t end,
                                                std::vector<PhotonTrace> reuse);

}  // namespace dspm
