// PNG files, through libpng.
#pragma once

#include <filesystem>
#include <string_view>

#include "dspm/image/image.h"

namespace dspm {

bool is_png(std::string_view bytes);
/// Any kind of PNG; 16 bits are kept. Throws std::runtime_error with the cause.
Image decode_png(std::string_view bytes, ColorEncoding encoding);

/// Eight bits per channel, sRGB: values of `image` (linear) outside 0..1 are clamped; NaN is black.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace dspm
