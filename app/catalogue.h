// All plugins of dspm and their parameters, for --list and --describe.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/params.h"
#include "modules/load.h"

namespace dspm {

struct CatalogueEntry {
  std::string kind, name, sentence, origin;
  std::function<std::vector<ParamInfo>()> params;
};

/// The kinds are called as in messages about scenes.
std::vector<CatalogueEntry> all_plugins();
/// Every kind with its plugins, a line each.
std::string list_plugins();
/// The parameters of a `kind:name`, or of each plugin of the name; throws UsageError where there is none.
std::string describe_plugins(std::string_view name);
bool is_plugin(std::string_view kind, std::string_view name);
/// A plugin as messages name it: `material "velvet" of libvelvet.so`; dspm's own without an origin.
std::string in_words(std::string_view kind, std::string_view name);
/// A module with what it brought along: `material "velvet" of libvelvet.so`.
std::string in_words(const LoadedModule& module);

}  // namespace dspm
