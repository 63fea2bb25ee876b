// Checks an EXR file's bytes before the library may read them.
#pragma once

#include <string_view>

namespace dspm {

/// Throws std::runtime_error if the header's attributes are damaged, and bounds what the library will allocate.
void check_exr(std::string_view bytes);

}  // namespace dspm
