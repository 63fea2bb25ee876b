// All sinks of a progressive integrator's iterations.
#pragma once

#include <memory>
#include <vector>

#include "dspm/integrators/integrator.h"
#include "dspm/integrators/methods/estimator.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct PixelSinks {
  PixelSinks() = default;
  PixelSinks(const EstimatorSettings& of, const EstimatorKind& kind, const Scene& scene, const RenderSettings& render);
  /// Returns the bytes that they will hold; unless batched, only those that they keep across iterations.
  static std::size_t bytes(const EstimatorSettings& of, const EstimatorKind& kind, const Scene& scene,
                           const RenderSettings& render);

  Estimators estimators;                         // two of the list
  std::vector<std::unique_ptr<PixelSink>> list;  // in the order in which checkpoints hold their states
};

}  // namespace dspm
