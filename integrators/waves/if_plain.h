// Traces paths in waves if the scene and the settings allow it, else one by one: what is left is the same.
#pragma once

#include <cstdint>
#include <vector>

#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Does what trace_photons() does.
std::vector<PhotonTrace> trace_photons_in_waves_if_plain(const Scene& scene, const PhotonSettings& settings,
                                                         std::uint64_t iteration, std::int64_t first, std::int64_t end,
                                                         std::vector<PhotonTrace> reuse);

/// Does what trace_hit_points() does, for every pixel.
std::vector<HitPointTile> trace_hit_points_in_waves_if_plain(const Scene& scene, const RenderSettings& render,
                                                             const HitPointSettings& settings, std::uint64_t iteration,
                                                             std::vector<HitPointTile> reuse);

}  // namespace dspm
