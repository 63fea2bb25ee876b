// The parameters of textures that sum octaves of noise.
#pragma once

#include "dspm/base/params/params.h"
#include "dspm/textures/noise.h"

namespace dspm {

/// Reads "octaves" and "roughness". Wrong values are errors, and their defaults apply.
Octaves read_octaves(ParamReader& reader);

}  // namespace dspm
