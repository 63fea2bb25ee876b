// Iterations that can be cancelled: the integrator's earlier state is kept.
#pragma once

#include "dspm/integrators/integrator.h"
#include "dspm/scene/scene.h"

namespace dspm {

/// One iteration that can be cancelled (system/cancellation.h). If it throws, the integrator is as it was before; it
/// must have persist(). Takes a copy of its state for that long; if there is no memory for it, the iteration is an
/// ordinary one.
void iterate_revertibly(Integrator& integrator, int iteration, const Scene& scene);

/// Bytes of the integrator's state; nothing if it keeps none (Integrator::persist).
std::optional<std::uint64_t> state_bytes(Integrator& integrator);

}  // namespace dspm
