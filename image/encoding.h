// Between the numbers of image files and linear light.
#pragma once

#include <vector>

#include "image/image.h"

namespace dspm {

/// [IEC 61966-2-1] Both are odd functions, so that negative values survive a round trip.
float srgb_to_linear(float encoded);
float linear_to_srgb(float linear);

/// The linear value of `encoded`; automatic leaves it as it is.
float decode(ColorEncoding encoding, float encoded);

/// Linear values of the integers 0 .. levels - 1, where levels - 1 stands for 1; automatic is sRGB here.
std::vector<float> decoding_table(ColorEncoding encoding, int levels);

}  // namespace dspm
