// BMP and TGA through stb_image, which is compiled here and nowhere else.
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "dspm/image/decoders.h"
#include "dspm/image/encoding.h"
#include "dspm/image/image.h"
#include "dspm/image/samples.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_FAILURE_STRINGS  // they are a global's, and shorter than what can be said here
#include <stb/stb_image.h>

namespace dspm {

namespace {

/// The bytes that stb_image reads. It takes bytes beyond the end as zeros, but asks for more only when it has used up
/// what it got, so a request that gets nothing is one beyond the end.
struct Source {
  std::string_view rest;
  bool ended = false;

  static Source& of(void* user) { return *static_cast<Source*>(user); }
  static int read(void* user, char* to, int count) {
    Source& source = of(user);
    const std::size_t taken = std::min(static_cast<std::size_t>(count), source.rest.size());
    if (taken == 0) source.ended = true;
    std::memcpy(to, source.rest.data(), taken);
    source.rest.remove_prefix(taken);
    return static_cast<int>(taken);
  }
  static void skip(void* user, int count) {
    Source& source = of(user);
    if (count > 0) source.rest.remove_prefix(std::min(static_cast<std::size_t>(count), source.rest.size()));
  }
  static int eof(void* user) { return of(user).rest.empty() ? 1 : 0; }
};

constexpr stbi_io_callbacks kCallbacks{&Source::read, &Source::skip, &Source::eof};

Image decode_by_stb(std::string_view bytes, ColorEncoding encoding) {
  int width = 0, height = 0, channels = 0;
  Source header{bytes};
  if (stbi_info_from_callbacks(&kCallbacks, &header, &width, &height, &channels) == 0) {
    throw std::runtime_error("its header is damaged or of an unsupported kind");
  }
  Image image =
      sized_image(width, std::abs(static_cast<std::int64_t>(height)), bytes.size());  // BMP: -height is top-down
  Source source{bytes};
  const std::unique_ptr<stbi_uc, void (*)(void*)> samples(
      stbi_load_from_callbacks(&kCallbacks, &source, &width, &height, &channels, 0), &stbi_image_free);
  if (source.ended) throw std::runtime_error("the file ends too early");
  if (!samples || width != image.width || height != image.height || channels < 1 || channels > 4) {
    throw std::runtime_error("its pixels are damaged or of an unsupported kind");
  }
  const std::size_t count = image.pixels.size() * static_cast<std::size_t>(channels);
  set_pixels<unsigned char>(image, {samples.get(), count}, static_cast<std::size_t>(channels),
                            decoding_table(encoding, 256));
  return image;
}

/// [Truevision TGA File Format Specification 2.0, 1991, "TGA file header"]
struct TgaHeader {
  explicit TgaHeader(std::string_view bytes) {
    const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(bytes[i])}; };
    const auto word = [&](std::size_t i) { return byte(i) | byte(i + 1) << 8; };
    if (bytes.size() < kBytes) return;
    kind = byte(2) & 7, encoded = (byte(2) & 8) != 0;
    bits = byte(16);
    const std::size_t palette_bits = byte(7);
    const auto colour = [](std::size_t n) { return n == 15 || n == 16 || n == 24 || n == 32; };
    width = word(12), height = word(14);
    const bool palette = kind == 1;
    valid = byte(1) == (palette ? 1 : 0) && byte(2) <= 11 && width > 0 && height > 0 &&
            (palette     ? (bits == 8 || bits == 16) && (colour(palette_bits))
             : kind == 2 ? colour(bits)
                         : kind == 3 && (bits == 8 || bits == 16));
    right_to_left = (byte(17) & 16) != 0;
    before_pixels = kBytes + byte(0) + (palette ? word(3) + word(5) * ((palette_bits + 7) / 8) : 0);
  }

  static constexpr std::size_t kBytes = 18;
  bool valid = false, encoded = false, right_to_left = false;
  std::size_t kind = 0, bits = 0, width = 0, height = 0, before_pixels = 0;
};

}  // namespace

bool is_bmp(std::string_view bytes) { return bytes.starts_with("BM"); }

Image decode_bmp(std::string_view bytes, ColorEncoding encoding) { return decode_by_stb(bytes, encoding); }

bool is_tga(std::string_view bytes) { return TgaHeader(bytes).valid; }

Image decode_tga(std::string_view bytes, ColorEncoding encoding) {
  const TgaHeader header(bytes);
  // What stb_image reads in blocks, not byte by byte, is checked here.
  const std::size_t pixels = header.encoded ? 0 : header.width * header.height * ((header.bits + 7) / 8);
  if (header.before_pixels + pixels > bytes.size()) throw std::runtime_error("the file ends too early");
  Image image = decode_by_stb(bytes, encoding);
  if (!header.right_to_left) return image;
  for (int y = 0; y < image.height; ++y) {
    const auto first = static_cast<std::ptrdiff_t>(image.index(0, y)), last = first + image.width;
    std::reverse(image.pixels.begin() + first, image.pixels.begin() + last);
    if (!image.alpha.empty()) std::reverse(image.alpha.begin() + first, image.alpha.begin() + last);
  }
  return image;
}

}  // namespace dspm
