// Shows numbers as colours.
#pragma once

#include <vector>

#include "dspm/image/image.h"

namespace dspm {

/// Makes 0 black, and `white` and above pale yellow, by the scale "magma" of matplotlib. The image is linear.
Image false_colours(const std::vector<float>& values, int width, float white = 1);

}  // namespace dspm
