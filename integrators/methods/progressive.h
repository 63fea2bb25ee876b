// The loop of dsppm and sppm: hit points, photons, photon map, statistics. Only their estimators differ.
#pragma once

#include "dspm/integrators/methods/estimator.h"
#include "dspm/integrators/methods/progressive_settings.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

std::unique_ptr<Integrator> make_progressive(const ProgressiveSettings& settings, const Scene& scene,
                                             const RenderSettings& render, const EstimatorKind& estimator);

}  // namespace dspm
