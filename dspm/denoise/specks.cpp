#include "dspm/denoise/specks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dspm/denoise/around.h"

namespace dspm {

Unspecked without_specks(const Image& radiance, const Image& variance, const Image& divisors) {
  constexpr float kFar = 3;       // standard deviations
  constexpr float kBrighter = 2;  // than all neighbours: what is less bright than that is the noise of all paths
  Unspecked result{radiance, variance};
  for_each_pixel(radiance, [&](std::size_t pixel, int x, int y) {
    for (int c = 0; c < 3; ++c) {
      const float own = radiance.pixels[pixel][c], own_variance = variance.pixels[pixel][c];
      if (!(own_variance > 0)) continue;
      float brightest = 0, least_certain = 0;
      around(radiance, x, y, 1, [&](std::size_t other) {
        if (other == pixel) return;
        const float ratio = divisors.pixels[pixel][c] / divisors.pixels[other][c];
        brightest = std::max(brightest, radiance.pixels[other][c] * ratio);
        least_certain = std::max(least_certain, variance.pixels[other][c] * ratio * ratio);
      });
      const float excess2 = (own - brightest) * (own - brightest), far2 = kFar * kFar;
      if (own > kBrighter * brightest && excess2 > far2 * least_certain && excess2 <= far2 * own_variance)
        result.radiance.pixels[pixel][c] = brightest, result.variance.pixels[pixel][c] = least_certain;
    }
  });
  return result;
}

}  // namespace dspm
