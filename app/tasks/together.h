// A render by several machines, which a tool such as mpirun has started.
#pragma once

#include "dspm/app/options/options.h"
#include "dspm/session/machines/link.h"

namespace dspm {

/// Does this machine's share of the task: the first one renders with the help of the others, and alone does tasks that
/// render nothing. Returns the exit code; throws what the task throws alone, and UsageError if its options do not go
/// together with other machines.
int render_together(const Options& options, Link& link);

}  // namespace dspm
