#include "bench/measure/noise.h"

#include <algorithm>

#include "bench/measure/convergence.h"
#include "dspm/base/colour/rgb.h"

namespace dspm {

double relative_square(const Image& a, const Image& b, const Image& truth) { return relative_product(a, b, b, truth); }

double relative_product(const Image& a, const Image& b, const Image& c, const Image& truth) {
  const double floor = error_floor(truth);
  double sum = 0;
  for (std::size_t p = 0; p < truth.pixels.size(); ++p) {
    const Rgb from_b = a.pixels[p] - b.pixels[p], from_c = a.pixels[p] - c.pixels[p];
    const double scale = luminance(truth.pixels[p]) + floor;
    for (int i = 0; i < 3; ++i) {
      const double product = static_cast<double>(from_b[i]) * from_c[i];
      if (product != 0) sum += std::clamp(product / (scale * scale), -1., 1.);
    }
  }
  return sum / static_cast<double>(3 * truth.pixels.size());
}

}  // namespace dspm
