// A module exports one function, which adds its plugins to dspm's tables, and the stamp of what it was built for.
//
//   DSPM_MODULE(registry) {
//     registry.add(dspm::material_plugins(), {"velvet", "cloth with a bright rim", make_velvet});
//   }
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "dspm/session/modules/stamp.h"

namespace dspm {

/// A module that cannot be used; what() names it and says what to do.
class ModuleError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Collects a module's plugins.
class ModuleRegistry {
 public:
  /// `module` must outlive the tables: plugins keep it as their origin.
  explicit ModuleRegistry(std::string_view module) : module_(module) {}

  /// The version of the dspm that loads the module: "0.3.0".
  static std::string_view host_version();

  /// Adds the plugin to the `table` of its kind: shape_plugins(), material_plugins(), texture_plugins<float>(), ...
  /// Throws ModuleError if the name is taken.
  template <class AnyPlugin>
  void add(PluginTable<AnyPlugin>& table, std::type_identity_t<AnyPlugin> plugin) {
    if (const AnyPlugin* other = table.find(plugin.name)) refuse(table.kind(), plugin.name, other->origin);
    plugin.origin = module_;
    table.add(plugin);
    ++count_;
  }
  /// The number of plugins that were added.
  int count() const { return count_; }

 private:
  [[noreturn]] void refuse(std::string_view kind, std::string_view name, std::string_view other) const;

  std::string_view module_;
  int count_ = 0;
};

/// The name and type of the function that a module exports.
inline constexpr const char* kModuleFunction = "dspm_module";
using ModuleFunction = void(ModuleRegistry&);

}  // namespace dspm

// A note section, so that the stamp can be read from the file.
#define DSPM_MODULE(registry)                                                                                   \
  extern "C" {                                                                                                  \
  __attribute__((section(".note.dspm"), used, visibility("default"),                                            \
                 aligned(4))) extern constexpr ::dspm::ModuleStamp dspm_module_stamp = ::dspm::current_stamp(); \
  __attribute__((visibility("default"))) void dspm_module(::dspm::ModuleRegistry&);                             \
  }                                                                                                             \
  void dspm_module([[maybe_unused]] ::dspm::ModuleRegistry& registry)
