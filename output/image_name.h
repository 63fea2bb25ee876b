// The names of image files: water.exr becomes water.0001.exr, chair.oak-red.exr or chair.oak-red.0001.exr.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "dspm/base/math/moments.h"

namespace dspm {

/// Returns the name of an image. `pattern` may say where the number goes, by %d, %04d or two or more # in the file's
/// name; otherwise it goes before the extension. Without a moment there is a number, 1, only if the pattern asks for
/// one. `label` names the variation; it comes before the number and may be empty.
std::filesystem::path image_name(const std::filesystem::path& pattern, std::optional<Moment> moment,
                                 std::string_view label = {});

}  // namespace dspm
