#include "dspm/integrators/possible_state.h"

#include <algorithm>
#include <limits>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/image/image.h"

namespace dspm {

void expect_images(const Integrator& integrator, int frames, bool spectral) {
  expect_iterations(integrator.statistics().iterations);
  // Infinite: a lamp overflowed. Negative: a few wavelengths, or a colour outside Rec. 709.
  const float least = spectral ? -std::numeric_limits<float>::infinity() : 0;
  const auto is_light = [least](const Rgb& c) { return c.r >= least && c.g >= least && c.b >= least; };
  for (int f = 0; f < frames; ++f) {
    const Image image = integrator.estimate(static_cast<Frame>(f), kRadiance);
    if (!std::all_of(image.pixels.begin(), image.pixels.end(), is_light))
      throw std::runtime_error("it is damaged: some of its pixels are negative, or no numbers");
  }
}

}  // namespace dspm
