#include "dspm/integrators/methods/estimator.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dspm/base/system/parallel.h"
#include "dspm/integrators/caught_light.h"
#include "dspm/integrators/photons/gather_beams.h"
#include "dspm/integrators/possible_state.h"

namespace dspm {

void PixelEstimator::see(std::span<const HitPointTile> tiles) {
  parallel_for(static_cast<std::int64_t>(tiles.size()), 1, [&](std::int64_t t) {
    for (const SeenLight& light : tiles[static_cast<std::size_t>(t)].seen)
      if (light.caught == of_.caught) add(light);
  });
}

// Hidden light and that of media come first. Their radii shrink like kz11's for both estimators, so that they are linear in
// the photons and can be added as seen light.
void PixelEstimator::gather(const PhotonBatch& batch, BatchCounts& counts) {
  gather_tiles(batch.tiles, counts.hidden, [&](const HitPointTile& tile, GatherCounts& work) {
    for (const HitPoint& hit : tile.glossy)
      if (hit.caught == of_.caught)
        gather_hidden(hit, tile, batch.hidden, of_.radius->squared(hit.radius), work,
                      [&](FrameSet frames, const Spectrum& radiance) {
                        add({frames, tile.palette->seen(radiance) / static_cast<float>(of_.photons), hit.pixel});
                      });
    for (const CameraBeam& beam : tile.beams)
      if (beam.caught == of_.caught)
        gather_beam(
            beam, tile, batch.in_media, of_.radius->of(1), work, [](int) { return true; },
            [&](FrameSet frames, const Spectrum& radiance) {
              add({frames, tile.palette->seen(radiance) / static_cast<float>(of_.photons), beam.pixel});
            });
  });
  if (batch.flux != nullptr && takes_flux()) return take_flux(batch, counts.photons);
  gather_tiles(batch.tiles, counts.photons, [&](const HitPointTile& tile, GatherCounts& work) {
    for (const HitPoint& hit : tile.hit_points)
      if (hit.caught == of_.caught) gather_at(hit, tile, batch.photons, work);
  });
}

void PixelEstimator::take_flux(const PhotonBatch& batch, std::vector<GatherCounts>& counts) {
  const FluxOfPoints& flux = *batch.flux;
  gather_tiles(batch.tiles, counts, [&](const HitPointTile& tile, GatherCounts& work) {
    std::size_t i = flux.first_point[static_cast<std::size_t>(&tile - batch.tiles.data())];
    for (const HitPoint& hit : tile.hit_points) {
      const PointFlux& point = flux.points[i];
      if (hit.caught == of_.caught) {
        take(hit, tile, flux.of(i));
        work.gathers.add(hit.frames.count());
        work.found += {point.found, point.found_separate};
        work.tests += point.tests;
      }
      ++i;
    }
  });
  for (const FluxOfPoints::Rejection& rejection : flux.rejections) {
    const auto above = std::ranges::upper_bound(flux.first_point, rejection.point);
    const auto t = static_cast<std::size_t>(above - flux.first_point.begin()) - 1;
    const HitPoint& hit = batch.tiles[t].hit_points[rejection.point - flux.first_point[t]];
    if (hit.caught == of_.caught)
      counts[t].rejections.add({SceneElement::Kind::material, rejection.material}, rejection.frames, hit.pixel);
  }
}

std::vector<PixelOutput> PixelEstimator::outputs(int /*iterations*/) const {
  return {{of_.caught ? caught_output() : radiance_output(),
           [this](int pixel, Frame frame) { return radiance(pixel, frame); }}};
}

void PixelEstimator::expect_possible_statistics() const {
  for (int pixel = 0; pixel < of_.pixels; ++pixel)
    for (Frame f = 0; f < of_.frames; ++f) {
      const std::optional<PixelStatistics> own = statistics(pixel, f);
      if (!own) return;  // none has
      expect_possible(own->R2 >= 0 && own->N >= 0 && std::isfinite(own->N), "its record of the pixels");
    }
}

}  // namespace dspm
