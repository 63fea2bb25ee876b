// Light that path tracing does not find: no ray meets a light without extent, and no shadow ray passes what refracts
// without roughness.
#pragma once

#include <string>

#include "dspm/world/scene/scene.h"

namespace dspm {

/// A sentence that names a light and what stands before it; empty if the scene has no such pair.
std::string missed_light(const Scene& scene);

}  // namespace dspm
