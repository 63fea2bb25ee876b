#include "dspm/session/revertible.h"

#include <new>
#include <optional>
#include <string>

#include "dspm/base/system/cancellation.h"
#include "dspm/base/system/state_in_memory.h"

namespace dspm {

namespace {

std::optional<std::string> copy_of(Integrator& integrator) {
  try {
    return state_of(integrator);
  } catch (const std::bad_alloc&) {
    return std::nullopt;
  }
}

}  // namespace

void iterate_revertibly(Integrator& integrator, const Iteration& iteration) {
  const std::optional<std::string> before = copy_of(integrator);
  if (!before) return integrator.iterate(iteration);
  try {
    const Cancellable nothing_is_lost;
    integrator.iterate(iteration);
  } catch (...) {
    load_state(*before, integrator);
    throw;
  }
}

std::optional<std::uint64_t> state_bytes(Integrator& integrator) {
  CountingStream counting;
  if (!integrator.persist(counting)) return std::nullopt;
  return counting.count();
}

}  // namespace dspm
