// The estimators of dynamic stochastic progressive photon mapping.
#pragma once

#include "dspm/integrators/methods/estimator.h"

namespace dspm {

/// Every pixel and frame shrinks its own radius [HJ09, WG12]; frames that share a hit point gather once.
EstimatorKind shared_hj09();
/// The radius depends only on the iteration [KZ11]; contributions shared by all frames are summed once.
EstimatorKind shared_kz11();

}  // namespace dspm
