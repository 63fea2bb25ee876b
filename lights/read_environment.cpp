#include "dspm/lights/read_environment.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/read_picture.h"

namespace dspm {

Image read_light_image(const std::filesystem::path& file, ParamReader& reader) {
  Image image = read_picture(file);
  std::size_t count = 0, first = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    Rgb& pixel = image.pixels[i];
    if (!is_finite(pixel) && count++ == 0) first = i;
    for (int c = 0; c < 3; ++c)
      if (!(pixel[c] > 0) || !std::isfinite(pixel[c])) pixel[c] = 0;
  }
  const auto width = static_cast<std::size_t>(image.width);
  if (count > 0)
    reader.warning(
        "filename",
        fmt::format("the picture's pixel {}, {} is not finite{}: what is not finite gives no light", first % width,
                    first / width, count > 1 ? fmt::format(", nor are {} more", count - 1) : ""));
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
