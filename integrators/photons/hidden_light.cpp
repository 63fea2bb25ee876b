#include "dspm/integrators/photons/hidden_light.h"

#include "dspm/integrators/photons/trace_photons.h"

namespace dspm {

void HiddenPhotons::build(const std::vector<PhotonTrace>& traces, int frames, float cell_size) {
  on_surfaces.build(traces, frames, cell_size, &PhotonTrace::hidden);
  on_curves.build(traces);
}

}  // namespace dspm
