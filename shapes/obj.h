// Meshes from Wavefront OBJ files.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dspm/shapes/mtl.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// The faces of one material (or of none), in the order of the file.
struct ObjMesh {
  std::string material;  // as `usemtl` names it
  MeshData mesh;
};

struct ObjFile {
  std::vector<ObjMesh> meshes;  // in the order in which their materials are first used
  std::vector<FileMaterial> materials;
  bool has_faces = false;               // of any group
  std::vector<std::string> groups;      // names of all groups and objects that have faces
  std::vector<std::string> complaints;  // faults that are no reason to stop: a missing MTL file, ...
};

/// Returns the text of a file that the OBJ file names, such as its materials; nullopt if there is none.
using ObjCompanion = std::function<std::optional<std::string>(const std::string& name)>;

/// Reads only faces of the group or object `group`, or all if it is empty. Without `split`, all faces form one ObjMesh.
/// Throws std::runtime_error with a sentence that does not name the file.
ObjFile read_obj(const std::filesystem::path& path, const std::string& group, bool split);
/// Reads a text in memory, as plain_text() returns it; textures are looked for in `directory`.
ObjFile parse_obj(const std::string& text, const std::filesystem::path& directory, const ObjCompanion& companion,
                  const std::string& group, bool split);

}  // namespace dspm
