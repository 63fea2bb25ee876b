// Plugins of a kind: one visible table of names and factories, the lookup by name, and the description of parameters.
// `Make` is the factory's function type: std::unique_ptr<Material>(ParamReader&, const MaterialContext&).
#pragma once

#include <algorithm>
#include <deque>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/base/params/params.h"

namespace dspm {

template <class Make>
struct Plugin {
  std::string_view name;
  std::string_view sentence;  // what it is, for `dspm --describe`
  Make* make;
  std::string_view origin = {};  // the module that it came with; empty: dspm itself
};

/// dspm's own plugins of a kind, followed by those of modules. Plugins never move once they are in the table.
template <class AnyPlugin>
class PluginTable {
 public:
  using Names = std::initializer_list<std::string_view>;

  /// `kind` is the word for the plugins ("material"); `not_built` holds the names that pbrt knows and dspm does not
  /// support.
  PluginTable(std::string_view kind, std::initializer_list<AnyPlugin> own, Names not_built = {})
      : kind_(kind), plugins_(own), not_built_(not_built) {}

  std::string_view kind() const { return kind_; }
  auto begin() const { return plugins_.begin(); }
  auto end() const { return plugins_.end(); }
  const AnyPlugin& front() const { return plugins_.front(); }
  const std::vector<std::string_view>& not_built() const { return not_built_; }

  /// Returns null if no plugin has that name.
  const AnyPlugin* find(std::string_view name) const {
    const auto found = std::find_if(begin(), end(), [&](const AnyPlugin& plugin) { return plugin.name == name; });
    return found != end() ? &*found : nullptr;
  }
  /// Like find() above, but an unknown name is an error at `where` that lists all plugins; names in `not_built` are
  /// unsupported.
  const AnyPlugin* find(std::string_view name, const SourceLocation& where, Diagnostics& diagnostics) const;

  /// Adds a plugin, whose name must be new.
  void add(const AnyPlugin& plugin) { plugins_.push_back(plugin); }

 private:
  std::string_view kind_;
  std::deque<AnyPlugin> plugins_;
  std::vector<std::string_view> not_built_;
};

template <class AnyPlugin>
const AnyPlugin* PluginTable<AnyPlugin>::find(std::string_view name, const SourceLocation& where,
                                              Diagnostics& diagnostics) const {
  if (const AnyPlugin* found = find(name)) return found;
  std::vector<std::string> names;
  std::string known = "available: ";
  for (const AnyPlugin& plugin : plugins_) {
    known += names.empty() ? "" : ", ";
    known += names.emplace_back(plugin.name);
  }
  const std::string subject = std::string(kind_) + " \"" + std::string(name) + "\"";
  if (std::find(not_built_.begin(), not_built_.end(), name) != not_built_.end()) {
    diagnostics.unsupported(where, subject + " is not supported by dspm", known);
    return nullptr;
  }
  const std::string guess = did_you_mean(name, names);
  diagnostics.error(where, "unknown " + subject, guess.empty() ? known : guess + " " + known);
  return nullptr;
}

/// Describes the parameters of a plugin, as its own factory asks for them. `context` holds the factory's arguments
/// after the reader.
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

/// Reports errors in the parameters, as the plugin's factory reads them, and makes nothing.
template <class Make, class... Context>
void check(const Plugin<Make>& plugin, ParamReader& reader, const Context&... context) {
  reader.only_check();
  try {
    plugin.make(reader, context...);
  } catch (const DescribedEnough&) {}
}

}  // namespace dspm
