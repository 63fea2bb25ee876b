// Writes one finished image to its file.
#pragma once

#include <filesystem>

#include "dspm/image/exr.h"
#include "dspm/image/film/film.h"
#include "dspm/image/image.h"
#include "dspm/output/view.h"

namespace dspm {

inline ExrPixels pixels_of(const FilmSettings& film) { return film.save_half ? ExrPixels::half : ExrPixels::single; }

/// Converts radiance, or a part of it, to the space that EXR files have it in.
Image in_film_space(Image image, const FilmSettings& film);

/// `image` holds the pixels of crop_of(film), in Rec. 709. The extension chooses OpenEXR, in the film's colour space,
/// with the place of the crop added to `header` and `more` layers, PNG or WebP as `view` shows it, transparent if the image has
/// an alpha (by which its colours are multiplied), or PFM or HDR, which hold nothing but the pixels. Throws WriteError.
void write_image(const std::filesystem::path& path, Image image, const FilmSettings& film, ExrHeader header,
                 const View& view = View(), const std::vector<ExrLayer>& more = {}, const ExrFormat& format = {});
/// Writes the layers alone, in an OpenEXR file.
void write_layers(const std::filesystem::path& path, const std::vector<ExrLayer>& layers, const FilmSettings& film,
                  ExrHeader header, const ExrFormat& format);

}  // namespace dspm
