// Sums what each group of lights brings to the pixels of a progressive integrator: the light of its photons, within the
// radii of the image's estimator. If a radius shrinks, tau and R^2 do so alike [WG12 (2), (4)], so a pixel's radiance
// is the mean over the iterations of phi / (pi R^2) at the radius that each of them had. That is linear in the photons,
// whatever the radii follow: groups add up to the image. What shadow catchers catch is in none of them.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/methods/estimator.h"
#include "dspm/integrators/photons/hidden_light.h"
#include "dspm/integrators/photons/photon_map.h"
#include "dspm/integrators/pixel_frames.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class GroupSums {
 public:
  GroupSums(LightGroups groups, const EstimatorSettings& of)
      : groups_(std::move(groups)), of_(of), sums_(std::int64_t{groups_.count()} * of.pixels, of.frames) {}
  static std::size_t bytes(const LightGroups& groups, const EstimatorSettings& of) {
    return PixelFrames<Rgb>::bytes(std::int64_t{groups.count()} * of.pixels, of.frames);
  }

  /// Adds light that needs no photons.
  void see(const std::vector<HitPointTile>& tiles);
  /// Adds a batch of an iteration's photons, before `whole`, the image's estimator, gathers them. The image keeps its
  /// bits, so its photons are gathered twice. The maps tell the groups apart. `hidden_radius` is the radius for hidden
  /// light.
  void gather(const std::vector<HitPointTile>& tiles, const PhotonMap& map, const PixelEstimator& whole,
              const HiddenPhotons& hidden, const IterationRadius& hidden_radius);
  void persist(StateStream& state) { state.sum(sums_.values()); }

  const LightGroups& groups() const { return groups_; }
  Rgb radiance(int group, int pixel, Frame frame, int iterations) const;

 private:
  template <class Radius2, class Gather>
  void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, float widest2, Radius2&& radius2,
                 Gather&& gather);
  std::int64_t row(int group, int pixel) const { return std::int64_t{group} * of_.pixels + pixel; }

  LightGroups groups_;
  EstimatorSettings of_;
  PixelFrames<Rgb> sums_;  // group by group: radiance times photon paths
};

}  // namespace dspm
