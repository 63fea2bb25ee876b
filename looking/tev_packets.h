// The messages of tev, an image viewer that other programs send images to. [github.com/Tom94/tev, Ipc.h and Ipc.cpp]
#pragma once

#include <string>
#include <vector>

#include "dspm/image/film/pixel_rect.h"

namespace dspm {

/// A message begins with its length in bytes, four bytes that count themselves, and its type. Integers are little
/// endian, texts end with a zero.
enum class TevMessage : char { close_image = 2, create_image = 4, update_image_v3 = 6 };

/// Creates a black image.
std::string tev_create_image(const std::string& name, int width, int height, const std::vector<std::string>& channels);

/// Updates a rectangle. `values` are those of its pixels row by row, the channels of a pixel one after the other.
std::string tev_update_image(const std::string& name, const PixelRect& where, const std::vector<std::string>& channels,
                             const std::vector<float>& values);

/// Closes an image. It is no error if there is none of that name.
std::string tev_close_image(const std::string& name);

}  // namespace dspm
