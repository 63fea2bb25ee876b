#include "dspm/integrators/methods/photon_batches.h"

#include <algorithm>

#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/methods/pixel_sinks.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/integrators/photons/memory_needs.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

// More and smaller batches cost time and save little: pixels then take most of the memory.
constexpr std::int64_t kMostBatches = 16, kLeastPaths = 4096;

/// Returns the bytes of pixels. With several batches, iterations are long: the plan includes a copy of the state
/// (session/revertible.h).
std::size_t pixel_bytes(EstimatorSettings of, const EstimatorKind& estimator, const Scene& scene,
                        const RenderSettings& render) {
  const std::size_t working = PixelSinks::bytes(of, estimator, scene, render);
  if (!of.batched) return working;
  of.batched = false;
  return working + PixelSinks::bytes(of, estimator, scene, render);
}

}  // namespace

EstimatorSettings estimator_settings(const ProgressiveSettings& settings, const Scene& scene,
                                     const RenderSettings& render, const PhotonBatches& batches,
                                     const IterationRadius* radius) {
  return {render.crop.count(), scene.frame_count(), settings.photons, settings.alpha, batches.are_many(), radius};
}

PhotonBatches batches_within_memory(const ProgressiveSettings& settings, const Scene& scene,
                                    const RenderSettings& render, const EstimatorKind& estimator,
                                    std::size_t learning) {
  if (render.memory == 0) return {settings.photons, settings.photons};
  const std::size_t guides = settings.photon.guides != nullptr ? settings.photon.guides->bytes() : 0;
  const double a_path = bytes_a_photon_path(scene, settings.photon, LightGroups(scene, render.outputs));
  const std::int64_t traced = std::max<std::int64_t>(settings.traced, 1);
  MemoryNeeds needs, least;
  needs.learning = learning;
  needs.hit_points = hit_point_bytes(scene, render, settings.hit_point);
  for (std::int64_t count = 1; count <= kMostBatches; ++count) {
    const PhotonBatches batches{traced, (traced + count - 1) / count};
    if (count > 1 && batches.size < kLeastPaths) break;
    needs.photons = static_cast<std::size_t>(a_path * static_cast<double>(batches.size));
    needs.pixels = pixel_bytes(estimator_settings(settings, scene, render, batches), estimator, scene, render) + guides;
    if (needs.total() <= render.memory) return batches;
    if (count == 1 || needs.total() < least.total()) least = needs;
  }
  throw NotEnoughMemory(least);
}

}  // namespace dspm
