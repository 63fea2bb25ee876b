#include "dspm/looking/overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "dspm/base/system/extension.h"
#include "dspm/image/exr.h"

namespace dspm {

Framing framing_of(const std::filesystem::path& file, const Image& image) {
  Framing framing{0, 0, image.width, image.height, image.width, image.height};
  if (extension_of(file) != ".exr") return framing;
  const ExrHeader header = read_exr_header(file);
  framing.x = header.x, framing.y = header.y;
  framing.full_width = header.full_width, framing.full_height = header.full_height;
  return framing;
}

Framing overlap_of(const std::string& first, const Framing& a, const std::string& second, const Framing& b) {
  const auto fail = [&](const char* why) {
    throw std::runtime_error(fmt::format("{} has {} x {} pixels, and {} has {} x {}{}", first, a.width, a.height,
                                         second, b.width, b.height, why));
  };
  const bool is_of_one = a.full_width == b.full_width && a.full_height == b.full_height;
  if (!is_of_one && (a.width != b.width || a.height != b.height)) fail("");
  if (!is_of_one) return a;
  Framing common = a;
  common.x = std::max(a.x, b.x), common.y = std::max(a.y, b.y);
  common.width = std::min(a.x + a.width, b.x + b.width) - common.x;
  common.height = std::min(a.y + a.height, b.y + b.height) - common.y;
  if (common.width <= 0 || common.height <= 0) fail(": they are parts of one picture, with no pixel in common");
  return common;
}

Image cut_out(const Image& image, const Framing& of, const Framing& part) {
  if (image.width == part.width && image.height == part.height) return image;
  Image result(part.width, part.height);
  if (!image.alpha.empty()) result.alpha.resize(result.pixels.size());
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) {
      const int from_x = part.x - of.x + x, from_y = part.y - of.y + y;
      result.at(x, y) = image.at(from_x, from_y);
      if (!image.alpha.empty()) result.alpha[result.index(x, y)] = image.alpha[image.index(from_x, from_y)];
    }
  return result;
}

}  // namespace dspm
