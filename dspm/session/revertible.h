// Iterations that may be given up: what an integrator had before them is kept.
#pragma once

#include "dspm/integrators/integrator.h"

namespace dspm {

/// One iteration, which loops may end by Cancelled (system/cancellation.h). If it throws, the integrator is as it was
/// before; it must have persist(). Takes a copy of its state for that long.
void iterate_revertibly(Integrator& integrator, int iteration);

/// Bytes of the integrator's state; nothing if it keeps none (Integrator::persist).
std::optional<std::uint64_t> state_bytes(Integrator& integrator);

}  // namespace dspm
