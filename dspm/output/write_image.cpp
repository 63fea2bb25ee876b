#include "dspm/output/write_image.h"

#include <utility>

#include "dspm/image/png.h"
#include "dspm/system/atomic_file.h"

namespace dspm {

void write_image(const std::filesystem::path& path, Image image, const FilmSettings& film, ExrHeader header,
                 const ToneMap& tone) {
  if (path.extension() == ".png") return write_png(path, shown(std::move(image), tone));
  if (path.extension() != ".exr") {
    throw WriteError(path, "images are .exr or .png files");
  }
  const PixelRect crop = crop_of(film);
  header.x = crop.x0, header.y = crop.y0;
  header.full_width = film.width, header.full_height = film.height;
  write_exr(path, image, header, film.save_half ? ExrPixels::half : ExrPixels::single);
}

}  // namespace dspm
