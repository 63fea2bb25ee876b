#include "dspm/machines/block.h"

#include <sstream>
#include <stdexcept>
#include <utility>

#include "dspm/checkpoint/loading_stream.h"
#include "dspm/system/state_in_memory.h"

namespace dspm {

std::string rendered(const Block& block, Integrator& integrator, const Scene& scene, const std::string& zero) {
  load(zero, integrator);
  for (int i = block.begin; i < block.end; ++i) integrator.iterate(i, scene);
  return state_of(integrator);
}

void add(std::string state, Integrator& integrator) {
  const std::size_t size = state.size();
  std::istringstream file(std::move(state));
  AddingStream adding(file, size);
  if (!integrator.persist(adding) || adding.left() != 0)
    throw std::runtime_error("the state of another machine belongs to another integrator");
}

void load(const std::string& state, Integrator& integrator) {
  LoadedState loaded(state);
  integrator.persist(loaded);
}

}  // namespace dspm
