// A picture whose columns are known by formula: things that emit light cross it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "dspm/image/image.h"

namespace dspm::test::flat_picture {

/// A picture of -4 <= x <= 4, -1 <= y <= 1, of `contents` that emit light.
inline std::string flat(const std::string& camera, const std::string& contents, const std::string& filter = "\"box\"") {
  return fmt::format(R"(
Frames 2
Integrator "path"
PixelFilter {}
Film "rgb" "integer xresolution" 32 "integer yresolution" 8
LookAt 0 0 -5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-4 4 -1 1] {}
WorldBegin
{}
)",
                     filter, camera, contents);
}

/// Returns the share of the times from `open` to `close` at which the square covers x. Its centre is at -2 + 4 t.
inline double covered(double x, double open, double close) {
  const double begin = std::max(open, (x - 0.5 + 2) / 4), end = std::min(close, (x + 0.5 + 2) / 4);
  return std::max(0., end - begin) / (close - open);
}

/// Returns the mean of fn over [low, high].
template <class Fn>
double mean(double low, double high, const Fn& fn) {
  constexpr int kSteps = 400;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += fn(low + (high - low) * (i + 0.5) / kSteps);
  return sum / kSteps;
}

/// Returns the mean of a column, whose pixels see the same times at other places.
inline double brightness(const Image& image, int x) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) sum += static_cast<double>(image.at(x, y).g);
  return sum / image.height;
}

}  // namespace dspm::test::flat_picture
