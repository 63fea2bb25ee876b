#include "dspm/image/denoise/specks.h"

#include <algorithm>
#include <cstddef>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/denoise/around.h"

namespace dspm {
namespace {

constexpr float kFar = 3;       // standard deviations
constexpr float kBrighter = 2;  // than all neighbours: what is less bright than that is the noise of all paths

bool is_speck(float own, float variance, float brightest, float least_certain) {
  const float excess2 = (own - brightest) * (own - brightest), far2 = kFar * kFar;
  return own > kBrighter * brightest && excess2 > far2 * least_certain && excess2 <= far2 * variance;
}

}  // namespace

Unspecked without_specks(const Image& radiance, const Image& variance, const Image& divisors) {
  Unspecked result{radiance, variance};
  for_each_pixel(radiance, [&](std::size_t pixel, int x, int y) {
    const Rgb &own = radiance.pixels[pixel], &own_variance = variance.pixels[pixel];
    Rgb brightest, least_certain;
    around(radiance, x, y, 1, [&](std::size_t other) {
      for (int c = 0; c < 3 && other != pixel; ++c) {
        const float ratio = divisors.pixels[pixel][c] / divisors.pixels[other][c];
        brightest[c] = std::max(brightest[c], radiance.pixels[other][c] * ratio);
        least_certain[c] = std::max(least_certain[c], variance.pixels[other][c] * ratio * ratio);
      }
    });
    bool any = false;
    for (int c = 0; c < 3; ++c) any = any || is_speck(own[c], own_variance[c], brightest[c], least_certain[c]);
    for (int c = 0; c < 3 && any; ++c) {
      result.radiance.pixels[pixel][c] = std::min(own[c], brightest[c]);
      result.variance.pixels[pixel][c] = std::min(own_variance[c], least_certain[c]);
    }
  });
  return result;
}

}  // namespace dspm
