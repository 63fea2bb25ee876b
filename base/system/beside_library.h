// Where dspm's own modules lie, which are loaded if they are needed.
#pragma once

#include <filesystem>
#include <string>

namespace dspm {

/// Returns the path of a file of that name next to the library that this code is in.
std::filesystem::path beside_library(const std::string& name);

}  // namespace dspm
