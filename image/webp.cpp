// WebP through libwebp.
#include <webp/decode.h>

#include <stdexcept>

#include "dspm/image/decoders.h"
#include "dspm/image/encoding.h"
#include "dspm/image/image.h"
#include "dspm/image/samples.h"

namespace dspm {

bool is_webp(std::string_view bytes) {
  return bytes.size() >= 12 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP";
}

Image decode_webp(std::string_view bytes, ColorEncoding encoding) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  WebPBitstreamFeatures features;
  const VP8StatusCode status = WebPGetFeatures(data, bytes.size(), &features);
  if (status == VP8_STATUS_NOT_ENOUGH_DATA) throw std::runtime_error("the file ends too early");
  if (status != VP8_STATUS_OK) throw std::runtime_error("its header is damaged");
  if (features.has_animation != 0) throw std::runtime_error("it is an animation; save one of its frames");
  Image image = sized_image(features.width, features.height, bytes.size());
  std::vector<std::uint8_t> samples(4 * image.pixels.size());
  if (WebPDecodeRGBAInto(data, bytes.size(), samples.data(), samples.size(), 4 * image.width) == nullptr) {
    throw std::runtime_error("its pixels are damaged or end too early");
  }
  set_pixels<std::uint8_t>(image, samples, 4, decoding_table(encoding, 256));
  return image;
}

}  // namespace dspm
