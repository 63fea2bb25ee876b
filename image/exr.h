// OpenEXR files; the files named exr* are the only places that know the library.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/base/colour/colour_space.h"
#include "dspm/image/image.h"

namespace dspm {

enum class ExrPixels { half, single };

enum class ExrCompression { none, rle, zips, zip, piz, dwaa, dwab };
/// Reads OpenEXR's names. dwaa and dwab lose a little of channels named R, G, B or Y, in any layer; the others lose
/// nothing.
std::optional<ExrCompression> exr_compression(std::string_view name);

/// The layout of a file's pixels.
struct ExrFormat {
  ExrCompression compression = ExrCompression::zip;
  int tile = 0;        // the side of tiles in pixels; 0: rows
  bool alone = false;  // compressed by the calling thread, as others write images at the same time
};

/// The contents of an image file besides the pixels. The names must not be those of OpenEXR's own attributes.
struct ExrHeader {
  std::map<std::string, std::string> texts;
  std::map<std::string, int> integers;
  std::map<std::string, double> numbers;                  // also for counts beyond 32 bits: exact up to 2^53
  std::map<std::string, std::array<float, 16>> matrices;  // row by row; points are rows: p' = p M
  ColourSpace space = ColourSpace::srgb;                  // of R, G and B, whose chromaticities are written
  double frames_per_second = 0;                           // 0: no animation
  int x = 0, y = 0;                     // where the pixels (data window) begin in the full image (display window)
  int full_width = 0, full_height = 0;  // 0: the pixels are the full image
  // Of a file that was read: its channels in alphabetical order, and how they lie in it.
  std::vector<std::string> channels;
  std::vector<ExrPixels> precisions;  // whole numbers count as single
  ExrFormat format;
};

/// One to three channels; the pixels' r, g and b are their values.
struct ExrLayer {
  std::vector<std::string> channels;
  const Image* image = nullptr;
  ExrPixels pixels = ExrPixels::half;
};

bool is_exr(std::string_view bytes);
/// Returns the data window of the first part: R, G and B, Y or Y with RY and BY, those of the only layer that has them,
/// or the only channel. Colours of other chromaticities become those of Rec. 709. Throws std::exception.
Image decode_exr(std::string_view bytes);

/// Writes one part with the channels of all layers. Halves end at 65504: brighter values are clamped to that. Layers of
/// different sizes are an error.
void write_exr(const std::filesystem::path& path, std::span<const ExrLayer> layers, const ExrHeader& header,
               const ExrFormat& format = {});
/// Writes one layer: R, G and B.
void write_exr(const std::filesystem::path& path, const Image& image, const ExrHeader& header,
               ExrPixels pixels = ExrPixels::half);
/// Returns these channels of a file's first part. Throws std::exception.
Image read_exr_channels(const std::filesystem::path& path, const std::vector<std::string>& channels);
ExrHeader read_exr_header(const std::filesystem::path& path);

}  // namespace dspm
