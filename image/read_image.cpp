#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>

#include "core/files_read.h"
#include "image/decoders.h"
#include "image/encoding.h"
#include "image/exr.h"
#include "image/png.h"

namespace dspm {

namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw std::runtime_error("there is no such file");
  if (!std::filesystem::is_regular_file(path, ignored)) throw std::runtime_error("it is not a regular file");
  std::string bytes(std::filesystem::file_size(path), '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw std::runtime_error("it cannot be read");
  note_file_read(path, bytes);
  return bytes;
}

Image decode_image(std::string_view bytes, ColorEncoding encoding) {
  if (is_png(bytes)) return decode_png(bytes, encoding);
  if (is_jpeg(bytes)) return decode_jpeg(bytes, encoding);
  if (!is_exr(bytes) && !is_hdr(bytes)) {
    throw std::runtime_error("it is neither a PNG, JPEG, OpenEXR nor Radiance HDR file");
  }
  Image image = is_exr(bytes) ? decode_exr(bytes) : decode_hdr(bytes);
  for (Rgb& pixel : image.pixels)
    pixel = {decode(encoding, pixel.r), decode(encoding, pixel.g), decode(encoding, pixel.b)};
  return image;
}

}  // namespace

Image sized_image(std::int64_t width, std::int64_t height, std::size_t file_bytes) {
  // Deflate reaches 1032 : 1, so one byte yields at most 8256 pixels of one bit. Up to 16 million are taken on trust.
  constexpr std::size_t kPixelsPerByte = 8256, kOnTrust = std::size_t{1} << 24;
  const std::size_t most = std::min(kMaxPixels, std::max(kOnTrust, kPixelsPerByte * file_bytes));
  if (width < 1 || height < 1) throw std::runtime_error("it has no size");
  if (static_cast<std::size_t>(width) > most / static_cast<std::size_t>(height)) {
    throw std::runtime_error(fmt::format("{} x {} pixels are too many", width, height));
  }
  return Image(static_cast<int>(width), static_cast<int>(height));
}

Image read_image(const std::filesystem::path& path, ColorEncoding encoding) {
  try {
    return decode_image(bytes_of(path), encoding);
  } catch (const std::bad_alloc&) {
    throw std::runtime_error("cannot read the image " + path.string() + ": it does not fit into memory");
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot read the image " + path.string() + ": " + error.what());
  }
}

}  // namespace dspm
