// Finds where two images show the same pixels of a picture: one or both of them may be a crop of it.
#pragma once

#include <filesystem>
#include <string>

#include "dspm/image/image.h"

namespace dspm {

/// An image file's place in the whole picture. Files other than OpenEXR do not say it: they are the whole.
struct Framing {
  int x = 0, y = 0, width = 0, height = 0;
  int full_width = 0, full_height = 0;
};
Framing framing_of(const std::filesystem::path& file, const Image& image);

/// Returns what the two have in common, in pixels of the whole picture; two images of one size have everything in
/// common. Throws std::runtime_error, naming the files, if they have nothing in common or are parts of pictures of
/// different sizes.
Framing overlap_of(const std::string& first, const Framing& a, const std::string& second, const Framing& b);

/// Returns those pixels of an image that is framed like `of`.
Image cut_out(const Image& image, const Framing& of, const Framing& part);

}  // namespace dspm
