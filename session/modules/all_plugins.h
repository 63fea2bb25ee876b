// Lists all plugins, of every kind, and how messages name them.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/base/params/params.h"
#include "dspm/session/modules/load.h"

namespace dspm {

struct CatalogueEntry {
  std::string kind, name, sentence, origin;
  std::function<std::vector<ParamInfo>()> params;
};

/// Returns all plugins. Kinds have the names that messages about scenes use.
std::vector<CatalogueEntry> all_plugins();
bool is_plugin(std::string_view kind, std::string_view name);
/// Returns a plugin as messages name it: `material "velvet" of libvelvet.so`; dspm's own have no origin.
std::string in_words(std::string_view kind, std::string_view name);
/// Returns a module with its plugins: `material "velvet" of libvelvet.so`.
std::string in_words(const LoadedModule& module);

}  // namespace dspm
