// Dynamic stochastic progressive photon mapping.
#pragma once

#include "integrators/integrator.h"

namespace dspm {

std::unique_ptr<Integrator> make_dsppm(ParamReader& params, const Scene& scene, const RenderSettings& render);

}  // namespace dspm
