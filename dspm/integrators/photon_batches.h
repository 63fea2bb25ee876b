// How many photon paths of an iteration are traced at a time: as many as the bound on memory lets.
#pragma once

#include "dspm/integrators/estimator.h"
#include "dspm/integrators/progressive_settings.h"
#include "dspm/scene/scene.h"

namespace dspm {

struct PhotonBatches {
  std::int64_t photons = 0;  // of an iteration
  std::int64_t size = 0;     // of a batch, but for the last one

  bool are_many() const { return size < photons; }
  int count() const { return static_cast<int>((photons + size - 1) / size); }
};

EstimatorSettings estimator_settings(const ProgressiveSettings& settings, const Scene& scene,
                                     const RenderSettings& render, const PhotonBatches& batches);

/// All photons at once, unless there is a bound. Throws NotEnoughMemory.
PhotonBatches batches_within_memory(const ProgressiveSettings& settings, const Scene& scene,
                                    const RenderSettings& render, const EstimatorKind& estimator);

}  // namespace dspm
