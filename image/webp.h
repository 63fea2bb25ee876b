// Still pictures as WebP, without loss. animation.h writes those that move.
#pragma once

#include <filesystem>

#include "dspm/image/image.h"

namespace dspm {

inline constexpr int kMostOfWebp = 16383;  // pixels a side

/// sRGB with eight bits a channel, of linear values; with alpha if the image has one. Throws WriteError.
void write_webp(const std::filesystem::path& path, const Image& image);

}  // namespace dspm
