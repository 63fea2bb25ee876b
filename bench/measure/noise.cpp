#include "bench/measure/noise.h"

#include <algorithm>

#include "dspm/colour/rgb.h"

namespace dspm {

double relative_square(const Image& a, const Image& b, const Image& truth) {
  double mean = 0, sum = 0;
  for (const Rgb& pixel : truth.pixels) mean += luminance(pixel);
  const double floor = 0.01 * mean / static_cast<double>(truth.pixels.size());
  for (std::size_t p = 0; p < truth.pixels.size(); ++p) {
    const Rgb difference = a.pixels[p] - b.pixels[p];
    const double scale = luminance(truth.pixels[p]) + floor;
    for (int c = 0; c < 3; ++c) {
      const double d = difference[c];
      if (d != 0) sum += std::min(1., d * d / (scale * scale));
    }
  }
  return sum / static_cast<double>(3 * truth.pixels.size());
}

}  // namespace dspm
