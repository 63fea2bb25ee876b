// Which extensions dspm reads.
#pragma once

#include <string>
#include <vector>

#include "dspm/gltf/document.h"

namespace dspm::gltf {

/// Throws std::runtime_error if the file requires one that dspm does not read. Notes about the others that it uses.
std::vector<std::string> check_extensions(const Document& document);

}  // namespace dspm::gltf
