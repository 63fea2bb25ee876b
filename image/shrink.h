// Shrinks images.
#pragma once

#include "dspm/image/image.h"

namespace dspm {

/// Makes every new pixel the mean of the area that it covers, with partly covered pixels weighted by area: the image's
/// mean is kept. So is alpha, which does not weight the colours. Meant for smaller sizes; larger ones repeat pixels.
Image shrunk(const Image& image, int width, int height);

}  // namespace dspm
