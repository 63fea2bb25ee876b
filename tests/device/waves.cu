// What the steps of waves do for one path or hit point: each thread of a device would call one of them.
#include "words.h"

#include <cstddef>

#include "dspm/integrators/waves/gather_wave.h"
#include "dspm/integrators/waves/wave_steps.h"

extern "C" __global__ void waves(const dspm::PhotonSteps* photons, const dspm::CameraSteps* camera,
                                 const dspm::GatherSteps* gather, std::size_t i) {
  (*photons)(i);
  (*camera)(i);
  (*gather)(i);
}
