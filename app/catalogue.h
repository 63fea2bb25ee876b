// All plugins of dspm and their parameters, for --list and --describe.
#pragma once

#include <string>
#include <string_view>

namespace dspm {

/// Every kind with its plugins, a line each.
std::string list_plugins();
/// The parameters of `kind:name`; throws UsageError where there is no such plugin.
std::string describe_plugin(std::string_view kind_and_name);

}  // namespace dspm
