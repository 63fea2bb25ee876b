#include "dspm/integrators/possible_state.h"

#include <algorithm>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/image/image.h"

namespace dspm {

void expect_images(const Integrator& integrator, int frames) {
  expect_iterations(integrator.statistics().iterations);
  const auto is_light = [](const Rgb& c) { return c.r >= 0 && c.g >= 0 && c.b >= 0; };  // infinite: a lamp overflowed
  for (int f = 0; f < frames; ++f) {
    const Image image = integrator.estimate(static_cast<Frame>(f), kRadiance);
    if (!std::all_of(image.pixels.begin(), image.pixels.end(), is_light))
      throw std::runtime_error("it is damaged: some of its pixels are negative, or no numbers");
  }
}

}  // namespace dspm
