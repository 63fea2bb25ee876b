// Dynamic stochastic progressive photon mapping.
#pragma once

#include "dspm/base/params/params.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/methods/estimator.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Every pixel and frame shrinks its own radius [HJ09, WG12]; frames that share a hit point gather once.
EstimatorKind shared_hj09();
/// The radius depends only on the iteration [KZ11]; contributions shared by all frames are summed once.
EstimatorKind shared_kz11();

std::unique_ptr<Integrator> make_dsppm(ParamReader& params, const Scene& scene, const RenderSettings& render);

}  // namespace dspm
