// A picture on the surface of a light, or on a screen before it: (0, 0) is its lower left corner, values between the
// centres of pixels are bilinear, and beyond the rim it continues as it ends there.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/image/image.h"

namespace dspm {

class EmissionPicture {
 public:
  /// Takes an image whose values must be finite; those below 0 count as 0.
  explicit EmissionPicture(Image image) : image_(std::move(image)) {
    for (Rgb& c : image_.pixels) c = {std::max(c.r, 0.f), std::max(c.g, 0.f), std::max(c.b, 0.f)};
  }

  Rgb at(Vec2 uv) const {
    const Taps x = taps(uv.x, image_.width), y = taps(1 - uv.y, image_.height);
    return (image_.at(x.first, y.first) * (1 - x.share) + image_.at(x.second, y.first) * x.share) * (1 - y.share) +
           (image_.at(x.first, y.second) * (1 - x.share) + image_.at(x.second, y.second) * x.share) * y.share;
  }

  friend bool operator==(const EmissionPicture&, const EmissionPicture&) = default;

 private:
  /// Two neighbouring pixels and the weight of the second.
  struct Taps {
    int first, second;
    float share;
  };
  static Taps taps(float s, int count) {
    // In this order of min and max, a coordinate that is NaN becomes the first pixel.
    const float last = static_cast<float>(count - 1);
    const float x = std::max(0.f, std::min(s * static_cast<float>(count) - 0.5f, last)), first = std::floor(x);
    const int i = static_cast<int>(first);
    return {i, std::min(i + 1, count - 1), x - first};
  }

  Image image_;
};

}  // namespace dspm
