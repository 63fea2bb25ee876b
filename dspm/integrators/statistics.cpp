#include "dspm/integrators/statistics.h"

namespace dspm {

void Statistics::persist(StateStream& state) {
  state.value(iterations);
  for (StepTime& step : steps) state.value(step.seconds);
  state.value(camera);
  state.value(photon);
  for (SharedCount* count : {&photons_stored, &gathers, &photons_found}) state.value(*count);
  state.value(photon_tests);
  rejections.persist(state);
  state.value(energy);
  state.value(typical);
  state.value(bytes);
  counters.persist(state);
  emission.persist(state);
}

}  // namespace dspm
