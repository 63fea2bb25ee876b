// Predicts what more threads would do for each step of a run.
#pragma once

#include <string>
#include <vector>

#include "dspm/integrators/statistics.h"

namespace dspm {

/// Returns the steps in which work was counted, in the order of a run. An integrator's `steps` and the rest of the
/// iterations come before all iterations, which are one of the steps `around` them.
std::vector<StepTime> worked_steps(const std::vector<StepTime>& around, const std::vector<StepTime>& steps);

/// Returns an empty text if no work was counted.
std::string scaling_table(const std::vector<StepTime>& around, const std::vector<StepTime>& steps);

}  // namespace dspm
