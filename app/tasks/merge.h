// The task "merge" of the command line.
#pragma once

#include "dspm/app/options/options.h"

namespace dspm {

/// Adds up the checkpoints of a render's parts, and writes what a run of all their iterations would have written.
/// Returns the exit code; throws like render_scene().
int merge_parts(const Options& options);

}  // namespace dspm
