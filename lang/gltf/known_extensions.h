// Knows which extensions dspm reads.
#pragma once

#include <string>
#include <vector>

#include "dspm/lang/gltf/document.h"

namespace dspm::gltf {

/// Throws std::runtime_error if the file requires an extension that dspm does not read. Returns notes about the others
/// that it uses.
std::vector<std::string> check_extensions(const Document& document);

}  // namespace dspm::gltf
