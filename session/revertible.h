// Iterations that can be cancelled: the integrator's earlier state is kept.
#pragma once

#include "dspm/integrators/integrator.h"

namespace dspm {

/// Runs one iteration that can be cancelled (base/system/cancellation.h). If it throws, the integrator, which must have
/// persist(), is as it was before. Takes a copy of its state for that long; if there is no memory for it, the iteration
/// is an ordinary one.
void iterate_revertibly(Integrator& integrator, const Iteration& iteration);

/// Returns the bytes of the integrator's state; nullopt if it keeps none (Integrator::persist).
std::optional<std::uint64_t> state_bytes(Integrator& integrator);

}  // namespace dspm
