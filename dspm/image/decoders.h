// What the readers of the single formats share, and those that only read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "dspm/image/image.h"

namespace dspm {

/// A black image of that size. Throws std::runtime_error before it allocates where the size is beyond kMaxPixels, or
/// beyond what a file of `file_bytes` holds in earnest: a damaged header must not take the machine's memory.
Image sized_image(std::int64_t width, std::int64_t height, std::size_t file_bytes);

/// A whole file of any of the formats. Throws std::runtime_error with the cause.
Image decode_image(std::string_view bytes, ColorEncoding encoding);

/// Through libjpeg: grey and colour, baseline and progressive; not CMYK. Throws std::runtime_error with the cause.
bool is_jpeg(std::string_view bytes);
Image decode_jpeg(std::string_view bytes, ColorEncoding encoding);

/// Radiance RGBE as the file has it; the header's EXPOSURE is not applied, as in pbrt and most other readers.
bool is_hdr(std::string_view bytes);
Image decode_hdr(std::string_view bytes);

}  // namespace dspm
