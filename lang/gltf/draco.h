// KHR_draco_mesh_compression.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "dspm/lang/gltf/accessor.h"

namespace dspm::gltf {

struct DracoMesh {
  std::map<std::string, Numbers> attributes;  // by glTF's names
  std::vector<std::uint32_t> corners;         // three to a triangle
};

/// Decodes a primitive; `how` is the extension's object in it. Throws std::runtime_error.
DracoMesh decode_draco(const Document& document, const Value& how);
bool reads_draco();

}  // namespace dspm::gltf
