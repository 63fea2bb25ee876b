// A rectangle of pixels, such as a crop.
#pragma once

namespace dspm {

/// Pixels x0 <= x < x1, y0 <= y < y1 of the full image.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  int count() const { return width() * height(); }
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

}  // namespace dspm
