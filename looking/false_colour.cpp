#include "dspm/looking/false_colour.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/encoding.h"

namespace dspm {
namespace {

/// The scale at 0, 1/8, ... 1, as sRGB. [van der Walt and Smith 2015, matplotlib's colour maps; CC0]
constexpr int kMagma[] = {0x000004, 0x1c1044, 0x4f127b, 0x812581, 0xb5367a, 0xe55064, 0xfb8761, 0xfec287, 0xfcfdbf};

Rgb magma(float v) {
  constexpr int kSteps = static_cast<int>(std::size(kMagma)) - 1;
  const float at = (v > 0 ? std::min(v, 1.f) : 0) * kSteps;
  const int step = std::min(static_cast<int>(at), kSteps - 1);
  Rgb result;
  for (int c = 0; c < 3; ++c) {
    const auto part = [&](int colour) { return static_cast<float>(colour >> (16 - 8 * c) & 0xff) / 255; };
    result[c] = srgb_to_linear(std::lerp(part(kMagma[step]), part(kMagma[step + 1]), at - static_cast<float>(step)));
  }
  return result;
}

}  // namespace

Image false_colours(const std::vector<float>& values, int width, float white) {
  Image image(width, static_cast<int>(values.size()) / width);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = magma(values[i] / white);
  return image;
}

}  // namespace dspm
