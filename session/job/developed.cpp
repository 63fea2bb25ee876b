#include "dspm/session/job/developed.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/integrators/beside/surface_output_list.h"

namespace dspm {
namespace {

/// Returns the colour of a spectral render as its file can hold it: where the film's colour space ends, it is clamped.
Rgb clamped_to_film(const Rgb& c, const FilmSettings& film, const std::optional<ColourMatrix>& to_film) {
  const Rgb held = map(to_film ? *to_film * c : c, [](float v) { return std::max(v, 0.f); });
  return to_film ? beyond_rec709(held, film.space, SpectrumRole::illuminant) : held;
}

}  // namespace

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
  const std::optional<ColourMatrix> to_film = to_film_space(job.film);
  for (Rgb& pixel : image.pixels) {
    if (job.settings.spectral) pixel = clamped_to_film(pixel, job.film, to_film);
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
