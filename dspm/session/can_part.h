// What a render must be for machines to share its iterations out.
#pragma once

#include <string>

#include "dspm/session/part.h"
#include "dspm/world/job.h"

namespace dspm {

/// Throws UsageError, which begins with `asked_by`, unless the integrator can.
void expect_parts(const Job& job, const Integrator& integrator, const std::string& asked_by);
/// Likewise, unless each part gets an iteration.
void expect_enough_iterations(int all, const Part& part, const std::string& asked_by);

}  // namespace dspm
