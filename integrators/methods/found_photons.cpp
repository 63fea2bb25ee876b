#include "dspm/integrators/methods/found_photons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/output_info.h"

namespace dspm {
namespace {

const OutputInfo kPhotons{"photons", {"photons.X"}, "photons found at the pixel's hit points so far", true};
const OutputInfo kRadius{"radius", {"radius.X"}, "search radius in world units, for the pixel's last hit point", true};

bool holds(const std::vector<std::string>& asked, const OutputInfo& output) {
  return std::find(asked.begin(), asked.end(), output.name) != asked.end();
}

}  // namespace

FoundPhotons::FoundPhotons(const EstimatorSettings& of, const Estimators& estimators,
                           const std::vector<std::string>& asked)
    : estimators_(estimators),
      radius_(*of.radius),
      counts_(holds(asked, kPhotons)),
      pixels_(bytes(of, asked) > 0 ? of.pixels : 0, of.frames) {}

std::size_t FoundPhotons::bytes(const EstimatorSettings& of, const std::vector<std::string>& asked) {
  return holds(asked, kPhotons) || holds(asked, kRadius) ? PixelFrames<Pixel>::bytes(of.pixels, of.frames) : 0;
}

void FoundPhotons::gather(const PhotonBatch& batch, BatchCounts& counts) {
  if (pixels_.empty()) return;
  gather_tiles(batch.tiles, counts.photons, [&](const HitPointTile& tile, GatherCounts&) {
    for (const HitPoint& hit : tile.hit_points)
      if (!hit.indirect) gather_at(hit, tile, batch.photons);
  });
}

void FoundPhotons::gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map) {
  const PixelEstimator& estimator = estimators_.of(hit);
  std::array<float, kMaxFrames> within2;
  hit.frames.for_each([&](Frame f) {
    within2[static_cast<std::size_t>(f)] = estimator.search_radius2_in(f, hit);
    pixels_.at(hit.pixel, f).initial_radius = hit.radius;
  });
  if (!counts_) return;
  GatherCounts not_counted;
  gather_photons(hit, tile.scattering_of(hit), map, estimator.search_radius2(hit), not_counted,
                 [&](const Strand*, FrameSet frames, SpectrumLanes, float distance2) {
                   frames.for_each([&](Frame f) {
                     pixels_.at(hit.pixel, f).photons += distance2 <= within2[static_cast<std::size_t>(f)];
                   });
                 });
}

std::vector<PixelOutput> FoundPhotons::outputs(int /*iterations*/) const {
  return {
      {kRadius, [this](int pixel, Frame frame) { return Rgb(radius(pixel, frame)); }},
      {kPhotons, [this](int pixel, Frame frame) { return Rgb(static_cast<float>(pixels_.at(pixel, frame).photons)); }}};
}

float FoundPhotons::radius(int pixel, Frame frame) const {
  std::optional<PixelStatistics> own = estimators_.image->statistics(pixel, frame);
  if (own && own->R2 == 0 && estimators_.caught != nullptr) own = estimators_.caught->statistics(pixel, frame);
  return own ? std::sqrt(own->R2) : radius_.of(pixels_.at(pixel, frame).initial_radius);
}

}  // namespace dspm
