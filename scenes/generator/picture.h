// Grey pictures by formulas.
#pragma once

#include "dspm/base/colour/rgb.h"
#include "dspm/image/image.h"

namespace dspm {

/// value(x, y) in each pixel's middle, x and y in 0..1 from the upper left corner.
template <class Value>
Image picture(int width, int height, const Value& value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = Rgb(value((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                 (static_cast<float>(y) + 0.5f) / static_cast<float>(height)));
  return image;
}

}  // namespace dspm
