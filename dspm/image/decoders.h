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

/// Through libjpeg: grey and colour, baseline and progressive; not CMYK. Throws std::runtime_error with the cause.
bool is_jpeg(std::string_view bytes);
Image decode_jpeg(std::string_view bytes, ColorEncoding encoding);

/// Radiance RGBE as stored; the header's EXPOSURE is not applied, as in pbrt and most other readers.
bool is_hdr(std::string_view bytes);
Image decode_hdr(std::string_view bytes);

}  // namespace dspm
