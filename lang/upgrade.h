// A file for pbrt-v3 as one for v4, comments kept: `dspm --upgrade`.
#pragma once

#include <optional>
#include <string>

#include "dspm/base/params/errors.h"

namespace dspm {

/// Returns what dspm makes of the file when it reads it, as canonical text. Files that it includes are left alone.
/// Returns nullopt, after an error, if it is for another version of pbrt, or cannot be translated. A note says what is
/// only close.
std::optional<std::string> upgrade_scene(const SourceFile& file, Diagnostics& diagnostics);

}  // namespace dspm
