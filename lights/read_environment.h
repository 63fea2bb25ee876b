// Pictures around a light: radiance of a sky, or what a lamp sends into each direction.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dspm/base/params/params.h"
#include "dspm/image/image.h"
#include "dspm/lights/environment_map.h"

namespace dspm {

/// The words for "string mapping": how the picture covers the sphere.
inline const std::vector<std::string> kMappingWords{"auto", "equalarea", "equirectangular"};

/// Reads the light's "filename" as a picture whose values light can have: what is negative or not finite becomes black,
/// and a warning names the pixels that are not finite. Throws std::runtime_error.
Image read_light_image(const std::filesystem::path& file, ParamReader& reader);

/// Returns the mapping; auto goes by the aspect ratio. Throws std::runtime_error if the picture's size does not fit.
SphereMapping mapping_of(const Image& image, const std::string& word);

}  // namespace dspm
