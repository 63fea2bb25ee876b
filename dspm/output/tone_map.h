// From radiance to what a screen can show: still linear, in 0..1; the sRGB curve is applied where a PNG is written.
#pragma once

#include <cmath>

#include "dspm/colour/rgb.h"
#include "dspm/image/image.h"

namespace dspm {

struct ToneMap {
  float exposure = 1;     // radiance 1 / exposure becomes white
  bool shoulder = false;  // roll bright colours off instead of clipping them
};

/// Clipping takes each component alone, as pbrt's images have it. The shoulder leaves colours alone up to 0.8 of their
/// largest component m, bends m towards 1 with a continuous slope above, and scales all components alike: the hue
/// stays. NaN and negative values become black.
inline Rgb shown(const Rgb& radiance, const ToneMap& tone) {
  constexpr float kKnee = 0.8f;
  const auto above_zero = [&](float v) { return v > 0 ? v * tone.exposure : 0.f; };
  const Rgb color(above_zero(radiance.r), above_zero(radiance.g), above_zero(radiance.b));
  const float largest = max_component(color);
  if (tone.shoulder && largest > kKnee && std::isfinite(largest)) {
    return color / largest * (1 - (1 - kKnee) * std::exp((kKnee - largest) / (1 - kKnee)));
  }
  return {std::min(color.r, 1.f), std::min(color.g, 1.f), std::min(color.b, 1.f)};
}

inline Image shown(Image image, const ToneMap& tone) {
  for (Rgb& pixel : image.pixels) pixel = shown(pixel, tone);
  return image;
}

}  // namespace dspm
