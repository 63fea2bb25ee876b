// Shared by the readers of the image formats, and the formats that are only read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "dspm/image/image.h"

namespace dspm {

/// A black image of that size. Throws std::runtime_error before it allocates if the size exceeds kMaxPixels, or what a
/// file of `file_bytes` can plausibly hold: a damaged header must not exhaust the machine's memory.
Image sized_image(std::int64_t width, std::int64_t height, std::size_t file_bytes);

/// A whole file of any of the formats. Throws std::runtime_error with the cause.
Image decode_image(std::string_view bytes, ColorEncoding encoding);

/// Through libjpeg: grey, colour and CMYK, baseline and progressive. Throws std::runtime_error with the cause.
bool is_jpeg(std::string_view bytes);
Image decode_jpeg(std::string_view bytes, ColorEncoding encoding);

/// Radiance RGBE: the radiance that the header's EXPOSURE and COLORCORR, which have been applied, say.
bool is_hdr(std::string_view bytes);
Image decode_hdr(std::string_view bytes);

/// Through stb_image. TGA has no signature: is_tga is true if the header makes sense as one.
bool is_bmp(std::string_view bytes);
Image decode_bmp(std::string_view bytes, ColorEncoding encoding);
bool is_tga(std::string_view bytes);
Image decode_tga(std::string_view bytes, ColorEncoding encoding);

/// P1 to P7 (PAM): the first picture of the file; numbers up to 65535.
bool is_pnm(std::string_view bytes);
Image decode_pnm(std::string_view bytes, ColorEncoding encoding);

/// Floating point; the values as stored, times the header's scale.
bool is_pfm(std::string_view bytes);
Image decode_pfm(std::string_view bytes);

/// Where the header says that its numbers are linear, automatic is linear.
bool is_qoi(std::string_view bytes);
Image decode_qoi(std::string_view bytes, ColorEncoding encoding);

/// Through libtiff: the first picture. 8 and 16 bits and single precision, grey or RGB; what else the library converts
/// to 8 bits (palettes, YCbCr, CMYK) is read as that.
bool is_tiff(std::string_view bytes);
Image decode_tiff(std::string_view bytes, ColorEncoding encoding);

/// Through libwebp: with and without loss; not animations.
bool is_webp(std::string_view bytes);
Image decode_webp(std::string_view bytes, ColorEncoding encoding);

}  // namespace dspm
