#include "dspm/integrators/statistics.h"

namespace dspm {

void Statistics::persist(StateStream& state) {
  state.part(iterations);
  for (StepTime& step : steps) state.part(step.seconds);
  state.part(camera);
  state.part(photon);
  for (SharedCount* count : {&photons_stored, &gathers, &photons_found}) state.part(*count);
  state.part(photon_tests);
  rejections.persist(state);
  state.part(energy);
  state.part(bytes);
  counters.persist(state);
}

}  // namespace dspm
