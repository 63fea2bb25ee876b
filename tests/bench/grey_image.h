// A row of grey pixels, for tests.
#pragma once

#include <initializer_list>

#include "dspm/image/image.h"

namespace dspm {

inline Image grey_image(std::initializer_list<float> values) {
  Image image(static_cast<int>(values.size()), 1);
  std::size_t p = 0;
  for (const float value : values) image.pixels[p++] = Rgb(value);
  return image;
}

}  // namespace dspm
