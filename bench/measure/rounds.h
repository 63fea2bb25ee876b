// Integrators that take turns, iteration by iteration, so that other load on the machine slows all of them alike: their
// times step by step, and the ratios of these.
#pragma once

#include <array>
#include <vector>

#include "bench/measure/run.h"

namespace dspm {

/// The steps of an iteration, and last their sum.
inline constexpr std::array<const char*, 5> kStepNames = {"hit points", "photons", "photon map", "statistics", "all"};
using StepSeconds = std::array<double, kStepNames.size()>;
/// One iteration per round.
using Rounds = std::vector<StepSeconds>;

/// One more iteration.
StepSeconds timed_iteration(const Run& run, int iteration);
/// Step by step.
StepSeconds medians(const Rounds& rounds);
/// Medians of the rounds' ratios.
StepSeconds ratios(const Rounds& over, const Rounds& under);

/// Runs that count as one, such as several frames of a scene one by one: their time is the mean.
using Group = std::vector<Run>;
/// By group. The first iteration, in which buffers grow, does not count if there are more.
std::vector<Rounds> in_turns(const std::vector<Group>& groups, int iterations);

}  // namespace dspm
