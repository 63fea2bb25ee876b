// The catalogue of plugins and their parameters, for --list and --describe.
#pragma once

#include <string>
#include <string_view>

namespace dspm {

/// Lists every kind with its plugins, one per line.
std::string list_plugins();
/// Describes the parameters of a `kind:name`, or of each plugin of that name; throws UsageError if there is none.
std::string describe_plugins(std::string_view name);

}  // namespace dspm
