// One finished image to its file.
#pragma once

#include <filesystem>

#include "dspm/film/film.h"
#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "dspm/output/tone_map.h"

namespace dspm {

/// `image` holds the pixels of crop_of(film). The extension chooses OpenEXR, with the place of the crop added to
/// `header`, or PNG through `tone`. Throws WriteError.
void write_image(const std::filesystem::path& path, Image image, const FilmSettings& film, ExrHeader header,
                 const ToneMap& tone = {});

}  // namespace dspm
