// Pictures of normals, which many files name where a bump map should be.
#pragma once

#include <filesystem>

namespace dspm {

/// Returns whether almost all of 2 rgb - 1 are of unit length, with z above 0, and coloured. Returns false if the
/// picture cannot be read.
bool holds_normals(const std::filesystem::path& picture);

}  // namespace dspm
