#include "dspm/session/modules/load.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "dspm/base/system/file_access.h"
#include "dspm/base/system/read_file.h"
#include "dspm/session/modules/elf_section.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

// Other threads may read them while one is being loaded: it counts once it is complete.
std::array<LoadedModule, kMostModules> modules;
std::atomic<std::size_t> module_count = 0;

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw ModuleError(fmt::format("module {}: {}", file.string(), why));
}

void check_stamp(const fs::path& file) {
  std::optional<std::string> stamp;
  try {
    stamp = elf_section(file, ".note.dspm");
  } catch (const std::runtime_error& error) {
    fail(file, error.what());
  }
  if (!stamp) fail(file, "it is not a module of dspm: it has no DSPM_MODULE");
  if (const std::string why = why_unfit(*stamp); !why.empty()) fail(file, why);
}

std::string loader_error() {
  const char* const text = dlerror();
  return text != nullptr ? text : "the reason is unknown";
}

/// Finds the lowest and the highest address that the loader has mapped.
void find_range(void* handle, LoadedModule& module) {
  struct Search {
    ElfW(Addr) base;
    LoadedModule& module;
  };
  const link_map* map = nullptr;
  if (dlinfo(handle, RTLD_DI_LINKMAP, &map) != 0) return;
  Search search{map->l_addr, module};
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* data) {
        auto& [base, found] = *static_cast<Search*>(data);
        if (info->dlpi_addr != base) return 0;
        found.begin = UINTPTR_MAX;
        for (int i = 0; i < info->dlpi_phnum; ++i) {
          const auto& segment = info->dlpi_phdr[i];
          if (segment.p_type != PT_LOAD) continue;
          found.begin = std::min<std::uintptr_t>(found.begin, base + segment.p_vaddr);
          found.end = std::max<std::uintptr_t>(found.end, base + segment.p_vaddr + segment.p_memsz);
        }
        return 1;
      },
      &search);
}

void register_plugins(const LoadedModule& module, void* handle) {
  void* const symbol = dlsym(handle, kModuleFunction);
  if (symbol == nullptr) fail(module.file, fmt::format("it does not export {}()", kModuleFunction));
  ModuleRegistry registry(module.name);
  try {
    reinterpret_cast<ModuleFunction*>(symbol)(registry);
  } catch (const std::exception& error) {
    fail(module.file, error.what());
  }
  if (registry.count() == 0) fail(module.file, "it adds no plugin");
}

}  // namespace

void load_module(const fs::path& file) {
  if (files_are_confined()) fail(file, "--sandbox loads no plugins");
  std::error_code error;
  const fs::path canonical = fs::canonical(file, error);
  if (error) fail(file, error.message());
  if (!fs::is_regular_file(canonical)) fail(file, "it is not a regular file");
  for (const LoadedModule& module : loaded_modules())
    if (module.file == canonical) return;
  if (module_count == kMostModules)
    fail(canonical, fmt::format("{} modules are loaded already, and that is the limit", kMostModules));
  check_stamp(canonical);
  static_cast<void>(read_bytes(canonical));  // so that checkpoints know of it, see base/system/files_read.h
  void* const handle = dlopen(canonical.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) fail(canonical, fmt::format("it cannot be loaded: {}", loader_error()));
  LoadedModule& module = modules[module_count];
  module.name = canonical.filename(), module.file = canonical;
  find_range(handle, module);
  register_plugins(module, handle);
  ++module_count;
}

std::span<const LoadedModule> loaded_modules() { return {modules.data(), module_count}; }

}  // namespace dspm
