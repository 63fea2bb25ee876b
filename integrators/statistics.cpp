#include "dspm/integrators/statistics.h"

namespace dspm {

void Statistics::persist(StateStream& state) {
  state.sum(iterations);
  for (StepTime& step : steps) state.sum(step.seconds);
  state.sum(camera);
  state.sum(photon);
  for (SharedCount* count : {&photons_stored, &gathers, &photons_found}) state.sum(*count);
  state.sum(photon_tests);
  rejections.persist(state);
  state.sum(energy);
  state.sum(cut_light);
  state.sum(typical);
  state.largest(bytes);
  counters.persist(state);
  emission.persist(state);
}

}  // namespace dspm
