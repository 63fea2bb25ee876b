#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/encoding.h"
#include "dspm/image/image.h"
#include "dspm/image/png.h"
#include "dspm/looking/terminal.h"

namespace dspm {
namespace {

constexpr std::size_t kPayload = 4096;  // the most that a command may carry
constexpr int kImageNumber = 4711, kPlacement = 1;

/// Encodes bytes. [RFC 4648]
std::string base64(std::string_view bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text.push_back(k > count ? '=' : kLetters[three >> (18 - 6 * k) & 63]);
  }
  return text;
}

constexpr int kLevels = 6;  // of each component

/// Returns the colours of all pixels as numbers of the palette, dithered in cells of 4 x 4. [Bayer 1973]
std::vector<int> palette_indices(const Image& image) {
  constexpr int kBayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
  const std::string bytes = srgb_bytes(image);
  std::vector<int> indices(image.pixels.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::size_t x = i % static_cast<std::size_t>(image.width), y = i / static_cast<std::size_t>(image.width);
    const float threshold = (static_cast<float>(kBayer[y % 4][x % 4]) + 0.5f) / 16;
    for (std::size_t c = 0; c < 3; ++c) {
      const float level = static_cast<float>(static_cast<unsigned char>(bytes[3 * i + c])) / 255 * (kLevels - 1);
      indices[i] = indices[i] * kLevels + std::min(static_cast<int>(level + threshold), kLevels - 1);
    }
  }
  return indices;
}

/// Encodes a row of sixels, each six pixels high, in one colour: lengths of runs and their bits.
std::string runs(const std::vector<int>& bits) {
  std::string text;
  for (std::size_t begin = 0; begin < bits.size();) {
    std::size_t end = begin;
    while (end < bits.size() && bits[end] == bits[begin]) ++end;
    text += fmt::format("!{}{}", end - begin, static_cast<char>(63 + bits[begin]));
    begin = end;
  }
  return text;
}

}  // namespace

std::string kitty_image(const Image& shown) {
  const std::string data = base64(png_bytes(shown));
  std::string text;
  for (std::size_t at = 0; at < data.size(); at += kPayload) {
    const std::string head = at == 0 ? fmt::format("a=T,f=100,i={},p={},C=1,q=2,", kImageNumber, kPlacement) : "";
    text += fmt::format("\x1b_G{}m={};{}\x1b\\", head, at + kPayload < data.size() ? 1 : 0, data.substr(at, kPayload));
  }
  return text;
}

std::string sixel_image(const Image& shown) {
  const std::vector<int> indices = palette_indices(shown);
  std::string text = fmt::format("\x1bP0;1q\"1;1;{};{}", shown.width, shown.height);
  constexpr int kColours = kLevels * kLevels * kLevels;
  const auto percent = [](int level) { return 100 * level / (kLevels - 1); };
  for (int i = 0; i < kColours; ++i)
    text += fmt::format("#{};2;{};{};{}", i, percent(i / (kLevels * kLevels)), percent(i / kLevels % kLevels),
                        percent(i % kLevels));
  const auto width = static_cast<std::size_t>(shown.width);
  for (int top = 0; top < shown.height; top += 6) {
    std::array<std::vector<int>, kColours> bits;
    for (int y = top; y < std::min(top + 6, shown.height); ++y)
      for (std::size_t x = 0; x < width; ++x) {
        std::vector<int>& row = bits[static_cast<std::size_t>(indices[static_cast<std::size_t>(y) * width + x])];
        row.resize(width);
        row[x] |= 1 << (y - top);
      }
    for (std::size_t i = 0; i < kColours; ++i)
      if (!bits[i].empty()) text += fmt::format("#{}{}$", i, runs(bits[i]));
    text += '-';
  }
  return text + "\x1b\\";
}

}  // namespace dspm
