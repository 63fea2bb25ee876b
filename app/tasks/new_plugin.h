// A starter project for a plugin outside of dspm's tree.
#pragma once

#include <filesystem>
#include <string>

namespace dspm {

/// Writes CMakeLists.txt, the source, and a scene that uses it, into a new or empty folder: they build, and ctest
/// renders the scene. `kind` is integrator, material, area-light, ...; `name` the plugin's. Returns what to type next.
/// Throws UsageError, before anything is written.
std::string new_plugin(const std::string& kind, const std::string& name, const std::filesystem::path& folder);

}  // namespace dspm
