// Camera subpaths of vertex connection and merging: at every vertex they look for the lights, are connected to the
// vertices of one light subpath, and merged with those of all.
#pragma once

#include "dspm/integrators/methods/vcm/light_subpaths.h"
#include "dspm/integrators/methods/vcm/light_vertex_map.h"
#include "dspm/integrators/methods/vcm/vcm_pass.h"
#include "dspm/integrators/seen_light.h"

namespace dspm {

/// Traces one camera path per pixel, in parallel over tiles. `map` holds the light subpaths' vertices; it is empty
/// without merging.
void trace_camera_subpaths(const VcmPass& pass, const LightSubpaths& light, const LightVertexMap& map,
                           SeenLightSums& sums, Statistics& statistics);

}  // namespace dspm
