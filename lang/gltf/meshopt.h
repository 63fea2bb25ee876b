// EXT_meshopt_compression and KHR_meshopt_compression.
#pragma once

#include <string>
#include <string_view>

#include "dspm/lang/gltf/value.h"

namespace dspm::gltf {

/// Expands `bytes` as the extension's object `how` says. Throws std::runtime_error.
std::string expand_meshopt(const Value& how, std::string_view bytes);
bool reads_meshopt();

}  // namespace dspm::gltf
