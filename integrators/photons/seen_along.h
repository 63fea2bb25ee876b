// What a camera path would see if it found its way to a light along the path of a photon: so pilot paths of photons tell
// how seldom and how bright that is.
#pragma once

#include "dspm/integrators/photons/photon_writer.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

LightSeen light_seen(const Emission& emission);

/// Returns PhotonPath::seen after the path is scattered along the sample.
float seen_along(const Scene& scene, const PhotonPath& path, const PhotonOrigin& from, const Vertex& vertex,
                 const BsdfSample& sample);

}  // namespace dspm
