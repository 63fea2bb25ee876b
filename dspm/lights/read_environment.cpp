#include "dspm/lights/read_environment.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "dspm/colour/rgb.h"

namespace dspm {

Image read_light_image(const std::filesystem::path& file) {
  Image image = read_image(file);
  for (Rgb& pixel : image.pixels)
    for (int c = 0; c < 3; ++c)
      if (!(pixel[c] > 0) || !std::isfinite(pixel[c])) pixel[c] = 0;
  return image;
}

SphereMapping mapping_of(const Image& image, const std::string& word) {
  const bool twice_as_wide = image.width == 2 * image.height;
  if (word == "equirectangular" || (word == "auto" && twice_as_wide)) return SphereMapping::equirectangular;
  if (image.width == image.height) return SphereMapping::equal_area;
  throw std::runtime_error(
      fmt::format("the image has {} x {} pixels, but the equal-area mapping needs a square; a "
                  "latitude-longitude image must be twice as wide as high, or needs "
                  "\"string mapping\" \"equirectangular\"",
                  image.width, image.height));
}

}  // namespace dspm
