// Ambient occlusion.
#pragma once

#include "dspm/integrators/integrator.h"
#include "dspm/params/params.h"
#include "dspm/scene/scene.h"

namespace dspm {

std::unique_ptr<Integrator> make_ambient_occlusion(ParamReader& params, const Scene& scene,
                                                   const RenderSettings& render);

}  // namespace dspm
