// What the targets of all image formats do: an image as large as it says, or a refusal.
#pragma once

#include <new>

#include "dspm/image/decoders.h"
#include "tests/fuzz/target.h"

namespace dspm::fuzz {

inline void decode(std::string_view bytes) {
  try {
    const Image image = decode_image(bytes, {});
    const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
    require(width > 0 && height > 0 && image.pixels.size() == width * height, "an image of another size");
  } catch (const std::logic_error&) {
    throw;
  } catch (const std::exception&) {}
}

}  // namespace dspm::fuzz
