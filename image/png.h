// PNG files, through libpng.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "dspm/image/image.h"

namespace dspm {

bool is_png(std::string_view bytes);
/// Decodes any kind of PNG; 16 bits are kept. Throws std::runtime_error with the cause.
Image decode_png(std::string_view bytes, ColorEncoding encoding);

/// The meaning of the numbers of a PNG, according to its chunks.
enum class PngSpace {
  srgb,        // the primaries of Rec. 709, sRGB's curve: sRGB, gAMA, cHRM
  display_p3,  // the primaries of P3, white D65, sRGB's curve: cICP, iCCP, gAMA, cHRM
  linear       // Rec. 709, not encoded: gAMA 1, cHRM
};

struct PngFormat {
  int bits = 8;  // or 16, per channel
  PngSpace space = PngSpace::srgb;
};

/// The image's values are linear, and already of the space's primaries; those outside 0..1 are clamped, NaN is black.
/// If it has an alpha, so has the file, whose colours are not multiplied by it, as in the image.
/// Throws std::runtime_error.
std::string png_bytes(const Image& image, const PngFormat& format = {});
void write_png(const std::filesystem::path& path, const Image& image, const PngFormat& format = {});

}  // namespace dspm
