// A picture in memory, and reading one from a file. Values are linear with Rec. 709 primaries, rows from the top.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "dspm/base/colour/rgb.h"

namespace dspm {

struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;   // row by row from the top, each from the left
  std::vector<float> alpha;  // of each pixel, if any is not opaque; colours are not multiplied by it, but EXR's may be

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  bool empty() const { return pixels.empty(); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  const Rgb& at(int x, int y) const { return pixels[index(x, y)]; }
  Rgb& at(int x, int y) { return pixels[index(x, y)]; }
  friend bool operator==(const Image&, const Image&) = default;
};

/// The meaning of a file's numbers: a value v in 0..1 stands for decode(v).
struct ColorEncoding {
  enum class Kind { automatic, srgb, linear, gamma };
  Kind kind = Kind::automatic;  // sRGB for integers (but EXR's), linear for floating point
  float exponent = 1;           // of gamma: v^exponent is linear

  /// pbrt's words: "sRGB", "linear", "gamma 2.2"; nullopt for others.
  static std::optional<ColorEncoding> parse(std::string_view words);
};

/// Reads PNG, JPEG, OpenEXR (the first part's R, G, B or Y), Radiance HDR, TIFF, WebP, QOI, BMP, PNM, PFM or TGA, told
/// apart by their first bytes. JPEG, HDR and PFM have no alpha. Throws std::runtime_error, naming the file and the
/// cause; never allocates for more than kMaxPixels.
Image read_image(const std::filesystem::path& path, ColorEncoding encoding = {});

inline constexpr std::size_t kMaxPixels = std::size_t{1} << 28;

}  // namespace dspm
