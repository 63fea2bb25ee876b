// Meshes and materials from Wavefront OBJ and MTL files, read by tinyobjloader.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/rgb.h"
#include "shapes/triangle_mesh.h"

namespace dspm {

/// What dspm takes of an MTL material.
struct ObjMaterial {
  std::string name;
  Rgb diffuse;                    // Kd
  std::filesystem::path texture;  // map_Kd; empty where there is none
};

/// The faces of one material (or of none), in the order of the file.
struct ObjPart {
  std::string material;  // as `usemtl` says it
  MeshData mesh;
};

struct ObjFile {
  std::vector<ObjPart> parts;  // in the order in which their materials are first used
  std::vector<ObjMaterial> materials;
  std::vector<std::string> groups;      // names of all groups and objects that have faces
  std::vector<std::string> complaints;  // what is odd but no reason to stop: a missing MTL file, ...
};

/// Only faces of the group or object `group`, or all where it is empty. Without `split` all faces are one part. Throws
/// std::runtime_error with a sentence that does not name the file.
ObjFile read_obj(const std::filesystem::path& path, const std::string& group, bool split);

}  // namespace dspm
