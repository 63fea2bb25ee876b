#include "dspm/app/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "dspm/modules/all_plugins.h"
#include "dspm/params/errors.h"

namespace dspm {
namespace {

std::string full_name(const CatalogueEntry& entry) { return entry.kind + ":" + entry.name; }

/// One line per parameter under a line of headings, in columns as wide as their contents.
std::string table_of(std::vector<ParamInfo> params) {
  params.insert(params.begin(), {"type", "name", "default", "", "meaning"});
  std::size_t types = 0, names = 0, defaults = 0;
  for (ParamInfo& info : params) {
    if (!info.unit.empty()) info.default_value += " " + info.unit;
    types = std::max(types, info.type.size());
    names = std::max(names, info.name.size());
    defaults = std::max(defaults, info.default_value.size());
  }
  std::string text;
  for (const ParamInfo& info : params)
    text += fmt::format("  {:<{}}  {:<{}}  {:<{}}  {}\n", info.type, types, info.name, names, info.default_value,
                        defaults, info.sentence);
  return text;
}

}  // namespace

std::string list_plugins() {
  const std::vector<CatalogueEntry> entries = all_plugins();
  std::size_t names = 0, origins = 0;
  for (const CatalogueEntry& entry : entries)
    names = std::max(names, entry.name.size()), origins = std::max(origins, entry.origin.size());
  std::string text, kind;
  for (const CatalogueEntry& entry : entries) {
    if (entry.kind != kind) text += fmt::format("{}{}\n", text.empty() ? "" : "\n", entry.kind);
    kind = entry.kind;
    text += fmt::format("  {:<{}}  {:<{}}  {}\n", entry.name, names, entry.origin, origins, entry.sentence);
  }
  return text;
}

std::string describe_plugins(std::string_view name) {
  std::string text;
  std::vector<std::string> names;
  for (const CatalogueEntry& entry : all_plugins()) {
    names.push_back(entry.name);
    names.push_back(full_name(entry));
    if (names.back() != name && entry.name != name) continue;
    const std::vector<ParamInfo> params = entry.params();
    text += fmt::format("{}{} ({}): {}\n{}", text.empty() ? "" : "\n", names.back(), entry.origin, entry.sentence,
                        params.empty() ? "" : table_of(params));
  }
  if (!text.empty()) return text;
  const std::string guess = did_you_mean(name, names);
  throw UsageError(fmt::format("--describe {}: there is no such plugin; {}", name,
                               guess.empty() ? "dspm --list shows all kinds and names" : guess));
}

}  // namespace dspm
