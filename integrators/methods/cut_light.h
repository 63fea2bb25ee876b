// Measures the light that the maximum depth cuts off. A sample of the pixels has a second path in early iterations,
// which goes on far beyond that depth; what it finds is no part of the picture, but tells how much light the picture
// lacks, and where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dspm/image/film/pixel_rect.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/methods/path_tracer.h"
#include "dspm/integrators/statistics.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns the number of the picture's regions: squares, 256 at most, of which those at the edges are cut off.
int region_count(const PixelRect& crop);
PixelRect region(const PixelRect& crop, int index);

/// Returns Statistics::cut_light as it is before the first iteration.
std::vector<CutLight> no_cut_light(const Scene& scene, const RenderSettings& render);

/// Returns the bytes that an integrator needs for it that keeps statistics twice.
std::size_t cut_light_bytes(const Scene& scene, const RenderSettings& render);

/// Adds to Statistics::cut_light what an iteration's sample finds, in the first eight iterations. `limits` are those of
/// the picture.
void count_cut_light(const Scene& scene, const RenderSettings& render, const PathLimits& limits,
                     std::uint64_t iteration, Statistics& statistics);

}  // namespace dspm
