// Stochastic progressive photon mapping, one frame at a time.
#pragma once

#include "dspm/base/params/params.h"
#include "dspm/integrators/integrator.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

std::unique_ptr<Integrator> make_sppm(ParamReader& params, const Scene& scene, const RenderSettings& render);

}  // namespace dspm
