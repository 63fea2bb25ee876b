// Conversion between the numbers of image files and linear light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "dspm/image/image.h"

namespace dspm {

/// Both are odd functions, so that negative values survive a round trip. [IEC 61966-2-1]
float srgb_to_linear(float encoded);
float linear_to_srgb(float linear);

/// The linear value of `encoded`; automatic leaves it unchanged.
float decode(ColorEncoding encoding, float encoded);

/// Linear values of the integers 0 .. levels - 1, where levels - 1 stands for 1; automatic is sRGB here.
std::vector<float> decoding_table(ColorEncoding encoding, int levels);

/// Red, green, blue and, if the image has it, alpha.
inline std::size_t channels_of(const Image& image) { return image.alpha.empty() ? 3 : 4; }

/// Bytes for a screen, eight bits for each of channels_of(image) in the order of the pixels: linear 0..1 as sRGB, other
/// values are clamped; NaN is black.
std::string srgb_bytes(const Image& image);

/// One integer of 0 .. levels - 1 per channel: linear 0..1, encoded as sRGB or left linear; likewise clamped. Alpha is
/// never encoded.
std::vector<std::uint16_t> encoded(const Image& image, int levels, bool srgb);

}  // namespace dspm
