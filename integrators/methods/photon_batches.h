// The number of photon paths traced at a time in an iteration: as many as the memory bound allows.
#pragma once

#include "dspm/integrators/methods/estimator.h"
#include "dspm/integrators/methods/progressive_settings.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct PhotonBatches {
  std::int64_t photons = 0;  // per iteration
  std::int64_t size = 0;     // of every batch but the last

  bool are_many() const { return size < photons; }
  int count() const { return static_cast<int>((photons + size - 1) / size); }
};

EstimatorSettings estimator_settings(const ProgressiveSettings& settings, const Scene& scene,
                                     const RenderSettings& render, const PhotonBatches& batches,
                                     const IterationRadius* radius = nullptr);

/// Traces all photons at once if there is no bound. `learning` is the number of bytes that were needed before the first
/// iteration. Throws NotEnoughMemory.
PhotonBatches batches_within_memory(const ProgressiveSettings& settings, const Scene& scene,
                                    const RenderSettings& render, const EstimatorKind& estimator, std::size_t learning);

}  // namespace dspm
