// The readers of the image formats share this, which also declares the formats that are only read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "dspm/image/image.h"

namespace dspm {

/// Returns a black image of that size. Throws std::runtime_error before it allocates if the size exceeds kMaxPixels, or
/// what a file of `file_bytes` can plausibly hold: a damaged header must not exhaust the machine's memory.
Image sized_image(std::int64_t width, std::int64_t height, std::size_t file_bytes);

/// Decodes a whole file of any of the formats. Throws std::runtime_error with the cause.
Image decode_image(std::string_view bytes, ColorEncoding encoding);

/// JPEG through libjpeg: grey, colour and CMYK, baseline and progressive. Throws std::runtime_error with the cause.
bool is_jpeg(std::string_view bytes);
Image decode_jpeg(std::string_view bytes, ColorEncoding encoding);

/// Radiance RGBE. Pixels become radiance again: the header's EXPOSURE and COLORCORR, which have been applied, are taken
/// out.
bool is_hdr(std::string_view bytes);
Image decode_hdr(std::string_view bytes);

/// BMP and TGA through stb_image. TGA has no signature: is_tga is true if the header makes sense as one.
bool is_bmp(std::string_view bytes);
Image decode_bmp(std::string_view bytes, ColorEncoding encoding);
bool is_tga(std::string_view bytes);
Image decode_tga(std::string_view bytes, ColorEncoding encoding);

/// The first picture of P1 to P7 (PAM); numbers up to 65535.
bool is_pnm(std::string_view bytes);
Image decode_pnm(std::string_view bytes, ColorEncoding encoding);

/// Floating-point pixels: the values as stored, times the header's scale.
bool is_pfm(std::string_view bytes);
Image decode_pfm(std::string_view bytes);

/// QOI. If the header says that its numbers are linear, automatic is linear.
bool is_qoi(std::string_view bytes);
Image decode_qoi(std::string_view bytes, ColorEncoding encoding);

/// The first picture of TIFF through libtiff. 8 and 16 bits and single precision, grey or RGB, are read as they are;
/// what else the library converts to 8 bits (palettes, YCbCr, CMYK) is read as that.
bool is_tiff(std::string_view bytes);
Image decode_tiff(std::string_view bytes, ColorEncoding encoding);

/// WebP through libwebp, with and without loss; not animations.
bool is_webp(std::string_view bytes);
Image decode_webp(std::string_view bytes, ColorEncoding encoding);

}  // namespace dspm
