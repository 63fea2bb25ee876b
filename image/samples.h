// Turns the integers of a file into an image.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "dspm/image/image.h"

namespace dspm {

/// Sets all pixels from `channels` samples each: 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha. `linear` is a
/// decoding_table of as many levels as T has. Alpha is never encoded, and is dropped if all of it is opaque.
template <class T>
void set_pixels(Image& image, std::span<const T> samples, std::size_t channels, const std::vector<float>& linear) {
  const bool grey = channels < 3, has_alpha = channels % 2 == 0;
  bool opaque = true;
  if (has_alpha) image.alpha.resize(image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const T* sample = samples.data() + i * channels;
    image.pixels[i] = {linear[sample[0]], linear[sample[grey ? 0 : 1]], linear[sample[grey ? 0 : 2]]};
    if (!has_alpha) continue;
    image.alpha[i] = static_cast<float>(sample[channels - 1]) / static_cast<float>(std::numeric_limits<T>::max());
    opaque = opaque && image.alpha[i] == 1;
  }
  if (opaque) image.alpha.clear();
}

}  // namespace dspm
