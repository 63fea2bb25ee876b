// Colour profiles for image files.
#pragma once

#include <string>

#include "dspm/base/colour/colour_space.h"

namespace dspm {

/// Returns the space's primaries with sRGB's curve, as a profile of version 4.3 for a screen. [ICC.1:2010]
std::string icc_profile(ColourSpace space, const std::string& name);

}  // namespace dspm
