// Loading modules: shared libraries outside of dspm that contain plugins.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "dspm/session/modules/module.h"

namespace dspm {

struct LoadedModule {
  std::string name;                   // of the file, without folders
  std::filesystem::path file;         // canonical
  std::uintptr_t begin = 0, end = 0;  // where its code and data lie
};

/// Adds the module's plugins to dspm's tables; a file that is already loaded is skipped. Its stamp is checked before
/// any of its code runs. Modules stay until the process ends. Throws ModuleError. Not for several threads at once.
void load_module(const std::filesystem::path& file);

inline constexpr std::size_t kMostModules = 64;
/// Returns the modules in the order of loading; addresses are stable.
std::span<const LoadedModule> loaded_modules();

}  // namespace dspm
