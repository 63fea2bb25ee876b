// The options of pictures in MTL files, as tinyobjloader expects them.
#pragma once

#include <string>

namespace dspm {

/// The text with all three numbers after each -s, -o and -t: in MTL the second and third may be missing, and tinyobjloader
/// would take the next words for them, the picture's name among them.
std::string with_all_numbers(const std::string& mtl);

}  // namespace dspm
