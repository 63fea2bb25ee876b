// Sums what each group of lights brings to the pixels of a progressive integrator: the light of its photons, within the
// radii of the image's estimator. If a radius shrinks, tau and R^2 do so alike [WG12 (2), (4)], so a pixel's radiance
// is the mean over the iterations of phi / (pi R^2) at the radius that each of them had. That is linear in the photons,
// whatever the radii follow: groups add up to the image. What shadow catchers catch is in none of them.
#pragma once

#include <cstdint>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/methods/estimator.h"
#include "dspm/integrators/pixel_frames.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class GroupSums final : public PixelSink {
 public:
  /// Sums the groups whose outputs are among `asked`. `whole` is the image's estimator.
  GroupSums(const EstimatorSettings& of, const PixelEstimator& whole, const Scene& scene,
            const std::vector<std::string>& asked);
  static std::size_t bytes(const EstimatorSettings& of, const LightGroups& groups) {
    return PixelFrames<Rgb>::bytes(std::int64_t{groups.count()} * of.pixels, of.frames);
  }

  void see(std::span<const HitPointTile> tiles) override;
  /// Asks the image's estimator for its radii, so it is called before its own. The image keeps its bits, so its photons
  /// are gathered twice. The maps tell the groups apart.
  void gather(const PhotonBatch& batch, BatchCounts& counts) override;
  void persist(StateStream& state) override { state.sum(sums_.values()); }
  std::vector<PixelOutput> outputs(int iterations) const override;

 private:
  template <class Radius2, class Gather>
  void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, float widest2, Radius2&& radius2,
                 Gather&& gather);
  std::int64_t row(int group, int pixel) const { return std::int64_t{group} * of_.pixels + pixel; }

  LightGroups groups_;
  std::vector<OutputInfo> infos_;  // of all groups of the scene
  EstimatorSettings of_;
  const PixelEstimator& whole_;
  PixelFrames<Rgb> sums_;  // group by group: radiance times photon paths
};

}  // namespace dspm
