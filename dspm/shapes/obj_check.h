// Numbers in OBJ files that are none, which tinyobjloader takes for 0.
#pragma once

#include <string>

namespace dspm {

/// Throws std::runtime_error that gives the line, unless all numbers of vertices, normals, texture coordinates and
/// faces are numbers, and as many as they need.
void check_obj_numbers(const std::string& text);

}  // namespace dspm
