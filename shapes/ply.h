// Meshes from PLY files: ASCII and binary, polygons of any number of corners, normals, texture coordinates.
#pragma once

#include <string_view>

#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// Takes the whole content of a file. Throws std::runtime_error with a sentence that says what is wrong and where.
MeshData read_ply(std::string_view file);

}  // namespace dspm
