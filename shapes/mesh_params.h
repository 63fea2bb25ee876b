// What all plugins that make meshes read, and how they say that a file is bad.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <filesystem>

#include "core/params.h"

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

inline void report_bad_file(ParamReader& reader, const std::filesystem::path& path, const std::exception& fault) {
  reader.error("filename", fmt::format("{} cannot be read: {}", path.string(), fault.what()));
}

}  // namespace dspm
