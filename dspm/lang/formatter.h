// The canonical form of a scene file: one directive a line, blocks indented, comments kept. Works on tokens alone, so
// it neither follows Include nor cares whether plugins exist.
#pragma once

#include <optional>
#include <string>

#include "dspm/params/errors.h"

namespace dspm {

/// Nothing, and an error, where the text does not even consist of tokens. The result means what the text meant, and is
/// formatted to itself.
std::optional<std::string> format_scene(const SourceFile& file, Diagnostics& diagnostics);

}  // namespace dspm
