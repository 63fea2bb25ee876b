#include "dspm/session/revertible.h"

#include <string>

#include "dspm/system/cancellation.h"
#include "dspm/system/state_in_memory.h"

namespace dspm {

void iterate_revertibly(Integrator& integrator, int iteration) {
  const std::string before = state_of(integrator);
  try {
    const Cancellable nothing_is_lost;
    integrator.iterate(iteration);
  } catch (...) {
    LoadedState state(before);
    integrator.persist(state);
    throw;
  }
}

std::optional<std::uint64_t> state_bytes(Integrator& integrator) {
  CountingStream counting;
  if (!integrator.persist(counting)) return std::nullopt;
  return counting.count();
}

}  // namespace dspm
