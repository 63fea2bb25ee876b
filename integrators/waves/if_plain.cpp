#include "dspm/integrators/waves/if_plain.h"

#include "dspm/integrators/waves/plain_objects.h"
#include "dspm/integrators/waves/wave_hit_points.h"
#include "dspm/integrators/waves/wave_photons.h"

namespace dspm {

std::vector<PhotonTrace> trace_photons_in_waves_if_plain(const Scene& scene, const PhotonSettings& settings,
                                                         std::uint64_t iteration, std::int64_t first, std::int64_t end,
                                                         std::vector<PhotonTrace> reuse) {
  if (!why_not_in_waves(scene, settings).empty())
    return trace_photons(scene, settings, iteration, first, end, std::move(reuse));
  const PlainObjects plain(scene);
  return trace_photons_in_waves(scene, plain.scene(), settings, iteration, first, end, std::move(reuse));
}

std::vector<HitPointTile> trace_hit_points_in_waves_if_plain(const Scene& scene, const RenderSettings& render,
                                                             const HitPointSettings& settings, std::uint64_t iteration,
                                                             std::vector<HitPointTile> reuse) {
  if (!why_not_in_waves(scene, settings).empty())
    return trace_hit_points(scene, render, settings, iteration, std::move(reuse));
  const PlainObjects plain(scene);
  return trace_hit_points_in_waves(scene, plain.scene(), render, settings, iteration, std::move(reuse));
}

}  // namespace dspm
