// Two-pass photon mapping.
#pragma once

#include "integrators/integrator.h"

namespace dspm {

std::unique_ptr<Integrator> make_photonmap(ParamReader& params, const Scene& scene, const RenderSettings& render);

}  // namespace dspm
