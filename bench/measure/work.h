// The work of runs in counts, step by step, to compare frames together with frames one by one.
#pragma once

#include "bench/measure/rounds.h"

namespace dspm {

/// By step: path segments, path segments, photons stored; gathers, distance tests and photons found.
using StepWork = std::array<std::vector<double>, kStepNames.size() - 1>;

/// Of the whole run so far.
StepWork work_of(const Integrator& integrator);
/// The mean of several runs.
StepWork mean_work(const Group& runs);

/// The most, by step, that `count` times the `separate` work can take over the time of `together`, if both need the
/// same time for the same kind of work: several kinds of work, each shared by a factor of its own, are shared by no
/// more than the largest of these. 0 for the total.
StepSeconds sharing_factors(const StepWork& separate, double count, const StepWork& together);

}  // namespace dspm
