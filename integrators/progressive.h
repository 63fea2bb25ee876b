// The loop of dsppm and sppm: hit points, photons, photon map, statistics. They differ in their estimators.
#pragma once

#include "integrators/estimator.h"
#include "integrators/progressive_settings.h"

namespace dspm {

std::unique_ptr<Integrator> make_progressive(const ProgressiveSettings& settings, const Scene& scene,
                                             const RenderSettings& render, const EstimatorKind& estimator);

}  // namespace dspm
