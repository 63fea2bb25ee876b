// The parameters that all mesh plugins read, and their error for a bad file.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <filesystem>

#include "dspm/base/params/params.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// The parameter for the world, which knows whether the mesh bounds a body and warns of holes.
inline constexpr const char* kOpenParam = "open";

inline bool read_repair(ParamReader& reader) {
  reader.flag(kOpenParam, false, "it is an open surface, and meant to be: no warning of its holes");
  return reader.flag("repair", false, "repair the mesh if it is not a closed surface");
}

/// Parameters for the world, which deforms meshes while the shutter is open.
inline constexpr const char* kBetweenParam = "between";
inline constexpr const char* kVelocityScaleParam = "velocityscale";

/// Checks the parameter that says what a sequence of files shows between its frames.
inline void read_between(ParamReader& reader) {
  reader.choice(kBetweenParam, "linear", {"linear", "hold"},
                "while the shutter is open, on the way to the next file of a sequence, or as in its own");
}

/// Reads "faceIndices", one number per face. Of pbrt's plugins, only the texture "ptex" asks for them, and dspm does
/// not have it.
inline void read_face_indices(ParamReader& reader, std::size_t faces) {
  const std::size_t count =
      reader.integers("faceIndices", "one number per face, for a texture that asks for it").size();
  if (count > 0 && count != faces)
    reader.error("faceIndices", fmt::format("{} face indices for {} faces", count, faces));
}

/// Reads "indices" and "P", including pbrt's default for a single triangle.
inline MeshData read_triangles(ParamReader& reader) {
  MeshData mesh;
  std::vector<int> indices = reader.integers("indices", "three vertex indices per triangle");
  mesh.vertices = reader.points3("P", "the vertices");
  if (indices.empty() && mesh.vertices.size() == 3) indices = {0, 1, 2};
  if (indices.size() % 3 != 0)
    reader.error("indices", fmt::format("the number of indices, {}, is not a multiple of 3", indices.size()));
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    mesh.faces.push_back({indices[i], indices[i + 1], indices[i + 2]});
  return mesh;
}

/// Returns `mesh` as a single MadeShape, or none after an error.
inline std::vector<MadeShape> made_mesh(ParamReader& reader, MeshData mesh, bool repair) {
  std::vector<MadeShape> made;
  if (const auto fault = fault_of(mesh))
    reader.error(mesh.vertices.empty() ? "P" : "indices", *fault);
  else
    made.push_back({std::make_unique<TriangleMesh>(std::move(mesh)), std::nullopt, repair});
  return made;
}

inline void report_bad_file(ParamReader& reader, const std::filesystem::path& path, const std::exception& fault) {
  reader.error("filename", fmt::format("{} cannot be read: {}", path.string(), fault.what()));
}

}  // namespace dspm
