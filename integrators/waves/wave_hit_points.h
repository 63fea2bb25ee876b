// Traces camera paths as trace_hit_points.h does, in waves: all paths of a tile by one bounce after the other, by the step
// that a device takes (camera_wave.h). Hit points and the light that paths see are the same, bit for bit, and so is their
// order for each pixel in each frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/waves/wave_tracer.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns what keeps the camera paths of these settings from being traced in waves, in words that follow "because"; empty
/// if nothing does.
std::string why_not_in_waves(const Scene& scene, const HitPointSettings& settings);
/// The same for a scene that is plain.
std::string why_not_by_settings(const Scene& scene, const HitPointSettings& settings);

/// Does what trace_hit_points() does, for a scene and settings of which why_not_in_waves() says nothing; `plain` is the
/// scene's, and `tracer` has it. What tiles have is the same, bit for bit, in the order of bounces; counts of rays are those of
/// the whole.
std::vector<HitPointTile> trace_hit_points_in_waves(const Scene& scene, const PlainScene& plain, WaveTracer& tracer,
                                                    const RenderSettings& render, const HitPointSettings& settings,
                                                    std::uint64_t iteration, std::vector<HitPointTile> reuse);

}  // namespace dspm
