// The task "plan" of the command line: how to share a render out among machines.
#pragma once

#include <string>

#include "dspm/app/options/options.h"

namespace dspm {

/// Returns the table of --plan. Throws like render_scene().
std::string plan_of(const Options& options);

}  // namespace dspm
