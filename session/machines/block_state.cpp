#include "dspm/session/machines/block_state.h"

#include <stdexcept>

#include "dspm/base/system/state_in_memory.h"

namespace dspm {

std::string rendered(const Block& block, Stage& stage, const std::string& zero) {
  load_state(zero, stage.integrator());
  for (int i = block.begin; i < block.end; ++i) stage.iterate(i);
  return state_of(stage.integrator());
}

void add(const std::string& state, Integrator& integrator) {
  AddedState added(state);
  if (!integrator.persist(added) || !added.all_read())
    throw std::runtime_error("the state of another machine belongs to another integrator");
}

}  // namespace dspm
