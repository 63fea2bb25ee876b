#include "dspm/integrators/beside/make_beside.h"

#include "dspm/integrators/photons/memory_needs.h"

namespace dspm {

std::unique_ptr<Integrator> make_beside(std::size_t taken, const MakeWithin& make, std::size_t memory) {
  if (memory == 0) return make(0);
  try {
    std::unique_ptr<Integrator> made = make(memory > taken ? memory - taken : 1);
    if (made == nullptr || taken < memory) return made;
    throw NotEnoughMemory({.pixels = made->statistics().bytes});  // it does not look at its memory
  } catch (NotEnoughMemory& error) {
    error.least.pixels += taken;
    if (error.least.learning > 0) error.least.learning += taken;
    throw;
  }
}

}  // namespace dspm
