// The Option directives that dspm has, for --describe.
#pragma once

#include <vector>

#include "dspm/base/params/params.h"

namespace dspm {

/// Returns the options as if they were parameters.
const std::vector<ParamInfo>& described_options();

}  // namespace dspm
