// A starter project for a plugin outside of dspm's tree.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dspm {

/// Writes CMakeLists.txt, the source, and a scene that uses it, into a new or empty folder: they build, and ctest
/// renders the scene. `kind` is integrator, material, shape, ...; `name` the plugin's. Returns what to type next.
/// Throws UsageError, before anything is written.
std::string new_plugin(std::string_view kind, const std::string& name, const std::filesystem::path& folder);

}  // namespace dspm
