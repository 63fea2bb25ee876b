// The canonical form of a scene file: one directive per line, blocks indented, comments kept. Works on tokens alone, so
// it neither follows Include nor cares whether plugins exist.
#pragma once

#include <optional>
#include <string>

#include "dspm/base/params/errors.h"

namespace dspm {

/// Returns nullopt, and reports an error, if the text does not even consist of tokens. The result means the same as the
/// text, and formatting it again does not change it.
std::optional<std::string> format_scene(const SourceFile& file, Diagnostics& diagnostics);

}  // namespace dspm
