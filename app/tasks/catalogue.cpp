#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "dspm/app/tasks/tasks.h"
#include "dspm/base/params/errors.h"
#include "dspm/lang/described_options.h"
#include "dspm/session/job/sampler.h"
#include "dspm/session/modules/all_plugins.h"

namespace dspm {
namespace {

std::string full_name(const CatalogueEntry& entry) { return entry.kind + ":" + entry.name; }

/// Returns one line per parameter under a line of headings, in columns as wide as their contents.
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

/// Returns all plugins, and what scenes give parameters without any.
std::vector<CatalogueEntry> all_described() {
  std::vector<CatalogueEntry> all = all_plugins();
  for (const std::string& name : sampler_names())
    all.push_back({"sampler", name, "dspm's own sequence, with pbrt's parameters", "dspm",
                   [name] { return sampler_params(name); }});
  all.push_back({"directive", "Option", "what holds for the whole scene: Option \"name\" value", "dspm",
                 [] { return described_options(); }});
  return all;
}

/// Returns a hint for a plugin that is of another kind than the name says: `light:diffuse`.
std::string of_other_kinds(std::string_view name, const std::vector<CatalogueEntry>& entries) {
  const std::size_t colon = name.find(':');
  if (colon == name.npos) return "";
  std::string found;
  for (const CatalogueEntry& entry : entries)
    if (entry.name == name.substr(colon + 1)) found += fmt::format("{}{}", found.empty() ? "" : ", ", full_name(entry));
  return found.empty() ? "" : "there is " + found;
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
  const std::vector<CatalogueEntry> entries = all_described();
  for (const CatalogueEntry& entry : entries) {
    names.push_back(entry.name);
    names.push_back(full_name(entry));
    if (names.back() != name && entry.name != name) continue;
    const std::vector<ParamInfo> params = entry.params();
    text += fmt::format("{}{} ({}): {}\n{}", text.empty() ? "" : "\n", names.back(), entry.origin, entry.sentence,
                        params.empty() ? "" : table_of(params));
  }
  if (!text.empty()) return text;
  std::string hint = of_other_kinds(name, entries);
  if (hint.empty()) hint = did_you_mean(name, names);
  throw UsageError(fmt::format("--describe {}: there is no such plugin; {}", name,
                               hint.empty() ? "dspm --list shows all kinds and names" : hint));
}

}  // namespace dspm
