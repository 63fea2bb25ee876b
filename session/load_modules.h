// Loads the modules that users name: on the command line, in DSPM_PLUGIN_PATH, in a scene.
#pragma once

#include <string>
#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"

namespace dspm {

/// Loads all modules in the folders of DSPM_PLUGIN_PATH (separated by colons), and `files`, those of --plugin. Throws
/// UsageError.
void load_modules(const std::vector<std::string>& files);

/// Loads the modules that the scene names: relative to the file that names them, else to the main file, else in
/// DSPM_PLUGIN_PATH.
void load_modules(const SceneDescription& description, Diagnostics& diagnostics);

}  // namespace dspm
