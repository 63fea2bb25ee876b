// From radiance to what a screen can show: still linear, in 0..1; the sRGB curve is applied when a PNG is written.
#pragma once

#include <cmath>

#include "dspm/colour/rgb.h"
#include "dspm/image/image.h"

namespace dspm {

struct ToneMap {
  float exposure = 1;     // radiance 1 / exposure becomes white
  bool shoulder = false;  // roll bright colours off instead of clipping them
};

/// Clipping treats each component alone, as in pbrt. The shoulder leaves colours alone if their largest component m is
/// at most 0.8, else bends m towards 1 with a continuous slope and scales all components alike, so that the hue stays.
/// NaN and negative values become black.
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
