// The choice between lobes that gather photons and lobes that extend a path, by the path's own random number.
#pragma once

#include "dspm/integrators/transport/gathering_lobes.h"
#include "dspm/integrators/transport/path_step.h"

namespace dspm {

inline LobeChoice choose_lobes(const Bsdf& bsdf, const PathState& path, const Vertex& vertex, float least_alpha) {
  return choose_lobes(bsdf, vertex.point, vertex.wo, least_alpha, path.random, path.bounces);
}

}  // namespace dspm
