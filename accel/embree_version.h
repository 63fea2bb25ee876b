// Which Embree builds trees.
#pragma once

#include <string_view>

namespace dspm {

/// Returns the version that the program was compiled for, such as "3.13.5".
std::string_view embree_version();

}  // namespace dspm
