#include <webp/encode.h>

#include <cstdint>
#include <string>

#include "dspm/base/system/atomic_file.h"
#include "dspm/image/encoding.h"
#include "dspm/image/image.h"
#include "dspm/image/webp.h"

namespace dspm {

void write_webp(const std::filesystem::path& path, const Image& image) {
  const std::string bytes = srgb_bytes(image);
  const auto* samples = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const int row = image.width * static_cast<int>(channels_of(image));
  std::uint8_t* data = nullptr;
  const std::size_t size = image.alpha.empty() ? WebPEncodeLosslessRGB(samples, image.width, image.height, row, &data)
                                               : WebPEncodeLosslessRGBA(samples, image.width, image.height, row, &data);
  const std::string file(reinterpret_cast<const char*>(data), size);
  WebPFree(data);
  if (size == 0)
    throw WriteError(path, image.width > kMostOfWebp || image.height > kMostOfWebp
                               ? "WebP images have at most 16383 pixels a side"
                               : "the WebP library cannot encode it");
  write_file(path, file);
}

}  // namespace dspm
