// Plugins of a folder: one visible table of names and factories, how one of them is found, and how it describes its
// parameters. `Make` is the factory's function type: std::unique_ptr<Material>(ParamReader&, const MaterialContext&).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "core/params.h"

namespace dspm {

template <class Make>
struct Plugin {
  std::string_view name;
  std::string_view sentence;  // what it is, for `dspm --describe`
  Make* make;
};

template <class AnyPlugin>
std::vector<std::string> names_of(std::span<const AnyPlugin> plugins) {
  std::vector<std::string> names;
  for (const AnyPlugin& plugin : plugins) names.emplace_back(plugin.name);
  return names;
}

/// The plugin of that name, or null after an error at `where` which lists all that there are. `kind` is the word for
/// them ("material"); `not_built` holds the names which pbrt knows and dspm does not have: those are unsupported.
template <class AnyPlugin>
const AnyPlugin* find_plugin(std::span<const AnyPlugin> plugins, std::string_view kind, std::string_view name,
                             const SourceLocation& where, Diagnostics& diagnostics,
                             std::span<const std::string_view> not_built = {}) {
  for (const AnyPlugin& plugin : plugins)
    if (plugin.name == name) return &plugin;

  const std::vector<std::string> names = names_of(plugins);
  std::string known = "there are: ";
  for (const std::string& each : names) known += (&each == names.data() ? "" : ", ") + each;
  const std::string subject = std::string(kind) + " \"" + std::string(name) + "\"";
  for (const std::string_view each : not_built) {
    if (each != name) continue;
    diagnostics.unsupported(where, subject + " is not built in dspm", known);
    return nullptr;
  }
  const std::string guess = did_you_mean(name, names);
  diagnostics.error(where, "unknown " + subject, guess.empty() ? known : guess + " " + known);
  return nullptr;
}

/// The parameters of a plugin, as its own factory asks for them. `context` is what the factory takes after the reader.
template <class Make, class... Context>
std::vector<ParamInfo> describe(const Plugin<Make>& plugin, const Context&... context) {
  std::vector<ParamInfo> described;
  Diagnostics ignored;
  ParamReader reader(described, ignored);
  try {
    plugin.make(reader, context...);
  } catch (const DescribedEnough&) {}
  return described;
}

}  // namespace dspm
