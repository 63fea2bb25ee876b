// The windows of OpenEXR files.
#pragma once

#include <string_view>

#include "dspm/image/image.h"

namespace dspm {

/// Returns the pixels of that file in its display window; unchanged if the two have nothing in common.
Image in_display_window(Image pixels, std::string_view exr);

}  // namespace dspm
