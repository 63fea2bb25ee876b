#include "dspm/session/job/developed.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/integrators/beside/surface_output_list.h"

namespace dspm {

Image exposed(Image image, const Job& job) {
  const std::optional<ColourMatrix> balance = white_balance(job.film);
  for (Rgb& pixel : image.pixels) {
    pixel *= job.exposure;
    if (balance) pixel = *balance * pixel;
  }
  return image;
}

Image developed(Image image, const Job& job) {
  image = exposed(std::move(image), job);
  for (Rgb& pixel : image.pixels) {
    if (job.settings.spectral) pixel = map(pixel, [](float c) { return std::max(c, 0.f); });
    pixel = limited(pixel, job.film.max_component);
  }
  return image;
}

Image with_alpha(Image radiance, const Image& alpha, const Job& job) {
  Image image = developed(std::move(radiance), job);
  image.alpha.clear();
  for (const Rgb& pixel : alpha.pixels) image.alpha.push_back(pixel.r);
  return image;
}

Image to_be_shown(const Integrator& integrator, Frame frame, const Job& job) {
  Image radiance = integrator.estimate(frame);
  if (!job.film.transparent) return developed(std::move(radiance), job);
  return with_alpha(std::move(radiance), integrator.estimate(frame, kAlphaOutput), job);
}

}  // namespace dspm
