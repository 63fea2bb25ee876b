// Finds out how long the film must be exposed to a file's own lights, which may be as bright as a lamp or as the sun.
#pragma once

#include <optional>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/lang/gltf/document.h"
#include "dspm/lang/gltf/poses.h"

namespace dspm::gltf {

/// Returns the illuminance, in lux, that these nodes' lights (KHR_lights_punctual) bring to a place of the file's world
/// in the first frame, if nothing is in the way.
double illuminance(const Document& document, const Poses& poses, const std::vector<std::size_t>& nodes, const Vec3& at);

/// Returns the power of two by which images are to be multiplied for a white surface to become about 1; nullopt if it
/// is neither too dark nor too bright as it is.
std::optional<double> exposure_for(double illuminance);

}  // namespace dspm::gltf
