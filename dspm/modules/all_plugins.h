// All plugins that there are, of every kind, and their names in messages.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/modules/load.h"
#include "dspm/params/params.h"

namespace dspm {

struct CatalogueEntry {
  std::string kind, name, sentence, origin;
  std::function<std::vector<ParamInfo>()> params;
};

/// The kinds are called as in messages about scenes.
std::vector<CatalogueEntry> all_plugins();
bool is_plugin(std::string_view kind, std::string_view name);
/// A plugin as messages name it: `material "velvet" of libvelvet.so`; dspm's own without an origin.
std::string in_words(std::string_view kind, std::string_view name);
/// A module with what it brought along: `material "velvet" of libvelvet.so`.
std::string in_words(const LoadedModule& module);

}  // namespace dspm
