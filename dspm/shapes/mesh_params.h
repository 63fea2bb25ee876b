// What all plugins that make meshes read, and how they say that a file is bad.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <filesystem>

#include "dspm/params/params.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

inline bool read_repair(ParamReader& reader) {
  return reader.flag("repair", false, "mend the mesh where it is no closed surface");
}

/// What pbrt's meshes have and dspm's do not.
inline void refuse_mesh_params(ParamReader& reader) {
  reader.unsupported("alpha", "surfaces that are cut out by a texture");
  reader.unsupported("displacement", "displaced surfaces");
  reader.unsupported("edgelength", "displaced surfaces");
  reader.unsupported("faceIndices", "textures by face");
  reader.unsupported("emissionfilename", "emission from an image");
}

/// Reads "indices" and "P", pbrt's default for a single triangle included.
inline MeshData read_triangles(ParamReader& reader) {
  MeshData mesh;
  std::vector<int> indices = reader.integers("indices", "three indices of vertices a triangle");
  mesh.vertices = reader.points3("P", "the vertices");
  if (indices.empty() && mesh.vertices.size() == 3) indices = {0, 1, 2};
  if (indices.size() % 3 != 0) reader.error("indices", fmt::format("{} indices do not make triangles", indices.size()));
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    mesh.faces.push_back({indices[i], indices[i + 1], indices[i + 2]});
  return mesh;
}

/// The part that `mesh` makes, or none after an error.
inline std::vector<ShapePart> mesh_part(ParamReader& reader, MeshData mesh, bool repair) {
  std::vector<ShapePart> parts;
  if (const auto fault = fault_of(mesh))
    reader.error(mesh.vertices.empty() ? "P" : "indices", *fault);
  else
    parts.push_back({std::make_unique<TriangleMesh>(std::move(mesh)), std::nullopt, repair});
  return parts;
}

inline void report_bad_file(ParamReader& reader, const std::filesystem::path& path, const std::exception& fault) {
  reader.error("filename", fmt::format("{} cannot be read: {}", path.string(), fault.what()));
}

}  // namespace dspm
