// --to-dsc: a glTF file as a scene that people can read and edit.
#pragma once

#include <string>

#include "dspm/app/options/options.h"

namespace dspm {

/// Writes shoe.dsc, and its meshes and pictures into the folder shoe, into the current directory, for each of the
/// files; says what was written. Throws UsageError, WriteError or std::runtime_error.
std::string written_as_dsc(const Options& options);

}  // namespace dspm
