// Small fixed-width lettering for contact sheets: printable ASCII in cells of 6 x 10 pixels, drawn for dspm.
#pragma once

#include <string_view>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/image.h"

namespace dspm {

inline constexpr int kTextAdvance = 6, kTextHeight = 10;  // pixels per character and line, at scale 1

/// Draws over `image`, from the upper left corner of the first character; text outside of it is clipped. Characters
/// other than ASCII appear as question marks.
void draw_text(Image& image, int left, int top, std::string_view text, int scale, const Rgb& color);

}  // namespace dspm
