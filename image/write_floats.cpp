#include "dspm/image/write_floats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/atomic_file.h"

namespace dspm {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Encodes a colour so that the largest component has a mantissa of 128 to 255.
std::array<unsigned char, 4> rgbe(const Rgb& c) {
  const float largest = max_component(c);
  int exponent = 0;
  if (!(largest > 1e-38f)) return {};
  const float scale = std::frexp(std::min(largest, 1e38f), &exponent) * 256 / std::min(largest, 1e38f);
  const auto mantissa = [&](float value) {
    return static_cast<unsigned char>(std::clamp(std::round(value * scale), 0.f, 255.f));
  };
  return {mantissa(c.r), mantissa(c.g), mantissa(c.b), static_cast<unsigned char>(exponent + 128)};
}

}  // namespace

void write_pfm(const std::filesystem::path& path, const Image& image) {
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", image.width, image.height);
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x) {
      const Rgb& c = image.at(x, y);
      const std::array<float, 3> values = {c.r, c.g, c.b};
      const std::size_t end = bytes.size();
      bytes.resize(end + sizeof values);
      std::memcpy(bytes.data() + end, values.data(), sizeof values);
    }
  write_file(path, bytes);
}

void write_hdr(const std::filesystem::path& path, const Image& image) {
  std::string bytes = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
  for (const Rgb& pixel : image.pixels)
    for (const unsigned char byte : rgbe(pixel)) bytes += static_cast<char>(byte);
  write_file(path, bytes);
}

}  // namespace dspm
