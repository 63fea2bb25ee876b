#include "dspm/looking/serve/picture.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/shrink.h"

namespace dspm {
namespace {

float channel_of(const Rgb& pixel, int channel) { return channel == 0 ? pixel.r : channel == 1 ? pixel.g : pixel.b; }

std::string deflated(const std::vector<unsigned char>& bytes) {
  z_stream stream = {};
  // Entropy coding alone: matches are rare, and looking for them takes most of the time.
  if (deflateInit2(&stream, 1, Z_DEFLATED, MAX_WBITS, 8, Z_HUFFMAN_ONLY) != Z_OK) throw std::bad_alloc();
  std::string result(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = const_cast<unsigned char*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<unsigned char*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  const int status = deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib cannot compress a picture");
  return result;
}

template <class Bits, class Encode>
std::vector<unsigned char> planes(const Image& image, int channels, const Encode& encode) {
  const std::size_t count = image.pixels.size();
  std::vector<unsigned char> bytes(count * static_cast<std::size_t>(channels) * sizeof(Bits));
  unsigned char* plane = bytes.data();
  for (int c = 0; c < channels; ++c, plane += count * sizeof(Bits)) {
    Bits before = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Bits bits = encode(channel_of(image.pixels[i], c));
      const auto difference = static_cast<Bits>(bits - before);
      before = bits;
      for (std::size_t b = 0; b < sizeof(Bits); ++b)
        plane[b * count + i] = static_cast<unsigned char>(difference >> (8 * (sizeof(Bits) - 1 - b)));
    }
  }
  return bytes;
}

/// Keeps every 2^halvings-th pixel.
Image thinned(const Image& image, int width, int height) {
  Image thin(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) thin.at(x, y) = image.at(x * image.width / width, y * image.height / height);
  return thin;
}

}  // namespace

std::uint16_t half_of(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000u);
  const float size = std::abs(value);
  if (std::isnan(value)) return static_cast<std::uint16_t>(sign | 0x7e00u);
  if (size >= 65520.f) return static_cast<std::uint16_t>(sign | 0x7c00u);
  // Below 2^-14 halves are multiples of 2^-24: adding 1/2 leaves exactly those bits at the end of a float.
  if (size < 0x1p-14f)
    return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(size + 0.5f) - 0x3f000000u));
  const std::uint32_t magnitude = bits & 0x7fffffffu;
  const std::uint32_t rounded = magnitude + 0xfffu + (magnitude >> 13 & 1u);
  return static_cast<std::uint16_t>(sign | (rounded - 0x38000000u) >> 13);
}

std::string packed(const Image& image, int channels, int bytes) {
  if (bytes == 2) return deflated(planes<std::uint16_t>(image, channels, half_of));
  return deflated(
      planes<std::uint32_t>(image, channels, [](float value) { return std::bit_cast<std::uint32_t>(value); }));
}

Picture make_picture(const Wish& wish, const OutputInfo& output, Image image) {
  const auto halved = [&](int length) { return std::max(length >> std::clamp(wish.halvings, 0, 16), 1); };
  const int width = halved(image.width), height = halved(image.height);
  if (width != image.width || height != image.height)
    image = output.is_id ? thinned(image, width, height) : shrunk(image, width, height);
  Picture picture;
  picture.wish = wish, picture.width = width, picture.height = height;
  picture.channels = static_cast<int>(std::clamp<std::size_t>(output.channels.size(), 1, 3));
  picture.bytes = output.single || output.is_id ? 4 : 2;
  picture.pixels = packed(image, picture.channels, picture.bytes);
  return picture;
}

}  // namespace dspm
