// What runs did, in counts, step by step: what is done together over what is done one by one.
#pragma once

#include "bench/measure/rounds.h"

namespace dspm {

/// By step: path segments, path segments, photons stored; gathers, distance tests and photons found.
using Work = std::array<std::vector<double>, kSteps.size() - 1>;

/// Of all that the run has done so far.
Work work_of(const Integrator& integrator);
/// The mean of several runs.
Work mean_work(const Group& runs);

/// The most that `count` times the `separate` work can take over what `together` takes, by step, if either does a piece
/// of work of the same kind in the same time: times of several kinds of work, each shared by a factor of its own, are
/// shared by no more than the largest of the factors. Nothing for the total.
StepSeconds sharing_factors(const Work& separate, double count, const Work& together);

}  // namespace dspm
