// Making an image smaller.
#pragma once

#include "dspm/image/image.h"

namespace dspm {

/// Every new pixel is the mean of the area that it covers, parts of pixels by their share: the image's mean is kept.
/// Made for smaller sizes; a larger one repeats pixels.
Image shrunk(const Image& image, int width, int height);

}  // namespace dspm
