// Stochastic progressive photon mapping, one frame at a time.
#pragma once

#include "integrators/integrator.h"

namespace dspm {

std::unique_ptr<Integrator> make_sppm(ParamReader& params, const Scene& scene, const RenderSettings& render);

}  // namespace dspm
