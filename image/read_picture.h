// Pictures that cover something: a surface, the sky, what a lamp projects.
#pragma once

#include "dspm/image/image.h"

namespace dspm {

/// Reads a picture as read_image() does, but with an EXR file's pixels (data window) where they are in the whole
/// picture (display window): around them it is black, and what lies outside of it is left out.
Image read_picture(const std::filesystem::path& path, ColorEncoding encoding = {});

}  // namespace dspm
