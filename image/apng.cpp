// APNG: a PNG whose further images lie in chunks that other readers skip. [PNG specification, third edition, 11.3.6]
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "dspm/image/animation.h"
#include "dspm/image/big_endian.h"
#include "dspm/image/image.h"

namespace dspm {
namespace {

using Chunk = std::function<void(const std::string& name, const std::string& content)>;
constexpr std::size_t kSignature = 8;
constexpr double kTicks = 1000;  // per second

void for_each_chunk(const std::string& png, const Chunk& chunk) {
  for (std::size_t at = kSignature; at + 12 <= png.size();) {
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(png[at + i]);
    chunk(png.substr(at + 4, 4), png.substr(at + 8, size));
    at += 12 + size;
  }
}

void append(std::string& file, const std::string& name, const std::string& content) {
  const std::string both = name + content;
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(both.data()), static_cast<uInt>(both.size()));
  file += big_endian(static_cast<std::uint32_t>(content.size())) + both + big_endian(static_cast<std::uint32_t>(crc));
}

/// Returns the control chunk of a frame that covers the whole image and replaces the one before.
std::string frame_control(std::uint32_t sequence, const Image& image, double seconds) {
  const auto ticks = static_cast<std::uint32_t>(std::clamp(std::lround(seconds * kTicks), 1l, 65535l));
  return big_endian(sequence) + big_endian(static_cast<std::uint32_t>(image.width)) +
         big_endian(static_cast<std::uint32_t>(image.height)) + big_endian(0) + big_endian(0) + big_endian(ticks, 2) +
         big_endian(static_cast<std::uint32_t>(kTicks), 2) + std::string(2, '\0');
}

}  // namespace

std::string apng_bytes(const std::vector<Image>& images, double seconds, const PngFormat& format) {
  std::string file;
  std::uint32_t sequence = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::string png = png_bytes(images[i], format);
    if (i == 0) file = png.substr(0, kSignature);
    bool is_first_data = true;
    for_each_chunk(png, [&](const std::string& name, const std::string& content) {
      if (name == "IDAT" && std::exchange(is_first_data, false))
        append(file, "fcTL", frame_control(sequence++, images[i], seconds));
      if (name == "IDAT" && i > 0) return append(file, "fdAT", big_endian(sequence++) + content);
      if (name == "IEND" || i > 0) return;
      append(file, name, content);
      if (name == "IHDR") append(file, "acTL", big_endian(static_cast<std::uint32_t>(images.size())) + big_endian(0));
    });
  }
  append(file, "IEND", "");
  return file;
}

}  // namespace dspm
