// Parameters that World reads for every plugin of a kind: they cannot have keys.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"

namespace dspm {

/// Reports an error if the directive gives this parameter a key.
inline void expect_same_in_all_frames(const PluginUse& use, std::string_view name, Diagnostics& diagnostics) {
  const std::vector<Param>& params = use.params.params;
  const auto keyed =
      std::find_if(params.begin(), params.end(), [&](const Param& param) { return param.name == name && param.key; });
  if (keyed != params.end())
    diagnostics.error(keyed->where, fmt::format("\"{}\" must be the same in all frames", name));
}

}  // namespace dspm
