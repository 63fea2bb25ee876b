// Checks whether what was derived from the first frames of a file (the choice of lights, the sphere around everything)
// serves the frames that were added to it since.
#pragma once

#include <functional>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/lang/description.h"
#include "dspm/world/lighting/bounding_sphere.h"
#include "dspm/world/lighting/light_choices.h"
#include "dspm/world/lighting/lighting.h"
#include "dspm/world/objects/geometry.h"

namespace dspm {

/// Reports an error for each reason why it does not, with the frames that are rendered and have it: their images would
/// lack light.
void expect_covered(const SceneDescription& description, const std::function<bool(FileFrame)>& is_rendered,
                    const Geometry& geometry, const BoundingSphere& sphere, const std::vector<WorldLight>& lights,
                    const LightChoices& choices, Diagnostics& diagnostics);

}  // namespace dspm
