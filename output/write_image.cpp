#include "dspm/output/write_image.h"

#include <fmt/format.h>

#include <utility>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/extension.h"
#include "dspm/image/png.h"
#include "dspm/image/webp.h"
#include "dspm/image/write_floats.h"

namespace dspm {

Image in_film_space(Image image, const FilmSettings& film) {
  if (const auto matrix = to_film_space(film))
    for (Rgb& pixel : image.pixels) pixel = *matrix * pixel;
  return image;
}

void write_layers(const std::filesystem::path& path, const std::vector<ExrLayer>& layers, const FilmSettings& film,
                  ExrHeader header, const ExrFormat& format) {
  header.space = film.space;
  const PixelRect crop = crop_of(film);
  header.x = crop.x0, header.y = crop.y0;
  header.full_width = film.width, header.full_height = film.height;
  write_exr(path, layers, header, format);
}

void write_image(const std::filesystem::path& path, Image image, const FilmSettings& film, ExrHeader header,
                 const View& view, const std::vector<ExrLayer>& more, const ExrFormat& format) {
  const std::string kind = extension_of(path);
  if (kind == ".png") return write_png(path, view.cut_out(std::move(image)), view.png());
  if (kind == ".webp") return write_webp(path, view.for_video().cut_out(std::move(image)));
  if (kind == ".pfm") return write_pfm(path, image);
  if (kind == ".hdr") return write_hdr(path, image);
  if (kind != ".exr") throw WriteError(path, fmt::format("images are {} files", kImageNames));
  image = in_film_space(std::move(image), film);
  std::vector<ExrLayer> layers = {{{"R", "G", "B"}, &image, pixels_of(film)}};
  layers.insert(layers.end(), more.begin(), more.end());
  write_layers(path, layers, film, std::move(header), format);
}

}  // namespace dspm
