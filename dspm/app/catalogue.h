// The catalogue of plugins and their parameters, for --list and --describe.
#pragma once

#include <string>
#include <string_view>

namespace dspm {

/// Every kind with its plugins, a line each.
std::string list_plugins();
/// The parameters of a `kind:name`, or of each plugin of the name; throws UsageError where there is none.
std::string describe_plugins(std::string_view name);

}  // namespace dspm
