// One finished image to its file.
#pragma once

#include <filesystem>

#include "film/film.h"
#include "film/tone_map.h"
#include "image/exr.h"
#include "image/image.h"

namespace dspm {

/// `image` holds the pixels of crop_of(film). The name's ending chooses OpenEXR, where `header` is completed by the place
/// of the crop, or PNG through `tone`. Throws WriteError.
void write_image(const std::filesystem::path& path, Image image, const FilmSettings& film, ExrHeader header,
                 const ToneMap& tone = {});

}  // namespace dspm
