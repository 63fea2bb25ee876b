// Path tracing.
#pragma once

#include "integrators/integrator.h"

namespace dspm {

std::unique_ptr<Integrator> make_path(ParamReader& params, const Scene& scene, const RenderSettings& render);

}  // namespace dspm
