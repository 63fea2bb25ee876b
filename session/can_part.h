// Checks whether machines can share out the iterations.
#pragma once

#include <string>

#include "dspm/session/job/job.h"
#include "dspm/session/part.h"

namespace dspm {

/// Throws UsageError, which begins with `asked_by`, unless the integrator can share out its iterations.
void expect_parts(const Job& job, const Integrator& integrator, const std::string& asked_by);
/// Throws UsageError, which begins with `asked_by`, unless each part gets an iteration.
void expect_enough_iterations(int all, const Part& part, const std::string& asked_by);

}  // namespace dspm
