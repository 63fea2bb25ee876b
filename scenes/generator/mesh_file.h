// Writes meshes: binary PLY, as small as possible, complete or not at all. The scenes read them by Shape "plymesh".
#pragma once

#include <filesystem>

#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// Vertices, normals and texture coordinates if there are any, and faces.
void write_ply(const std::filesystem::path& file, const MeshData& mesh);

}  // namespace dspm
