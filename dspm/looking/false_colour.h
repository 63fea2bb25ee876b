// Numbers as colours.
#pragma once

#include <vector>

#include "dspm/image/image.h"

namespace dspm {

/// 0 is black, `white` and above are pale yellow, by the scale "magma" of matplotlib. The image is linear.
Image false_colours(const std::vector<float>& values, int width, float white = 1);

}  // namespace dspm
