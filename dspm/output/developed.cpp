#include "dspm/output/developed.h"

#include <optional>
#include <utility>

#include "dspm/colour/rgb.h"

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
  for (Rgb& pixel : image.pixels) pixel = limited(pixel, job.film.max_component);
  return image;
}

}  // namespace dspm
