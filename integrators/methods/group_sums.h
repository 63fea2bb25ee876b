// Sums what each group of lights brings to the pixels of a progressive integrator: the light of its photons, within the
// radii of the image's estimator. If a radius shrinks, tau and R^2 do so alike [WG12 (2), (4)], so a pixel's radiance
// is the mean over the iterations of phi / (pi R^2) at the radius that each of them had. That is linear in the photons,
// whatever the radii follow: groups add up to the image. What shadow catchers catch is in none of them.
#pragma once

#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/methods/estimator.h"
#include "dspm/integrators/photons/hidden_light.h"
#include "dspm/integrators/photons/photon_map.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class GroupSums {
 public:
  GroupSums(LightGroups groups, const EstimatorSettings& of)
      : groups_(std::move(groups)), of_(of), sums_(bytes(groups_, of) / sizeof(Rgb)) {}
  static std::size_t bytes(const LightGroups& groups, const EstimatorSettings& of) {
    return static_cast<std::size_t>(groups.count()) * of.pixel_frames() * sizeof(Rgb);
  }

  /// Adds light that needs no photons.
  void see(const std::vector<HitPointTile>& tiles);
  /// Adds a batch of an iteration's photons, before `whole`, the image's estimator, gathers them. The image keeps its
  /// bits, so its photons are gathered twice. The maps tell the groups apart. `hidden_radius` is the radius for hidden
  /// light.
  void gather(const std::vector<HitPointTile>& tiles, const PhotonMap& map, const PixelEstimator& whole,
              const HiddenPhotons& hidden, const IterationRadius& hidden_radius);
  void persist(StateStream& state) { state.sum(sums_); }

  const LightGroups& groups() const { return groups_; }
  Rgb radiance(int group, int pixel, Frame frame, int iterations) const;

 private:
  template <class Radius2, class Gather>
  void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, float widest2, Radius2&& radius2,
                 Gather&& gather);
  Rgb& sum(int group, int pixel, Frame frame) { return sums_[index(group, pixel, frame)]; }
  std::size_t index(int group, int pixel, Frame frame) const {
    return static_cast<std::size_t>(group) * of_.pixel_frames() +
           static_cast<std::size_t>(pixel) * static_cast<std::size_t>(of_.frames) + static_cast<std::size_t>(frame);
  }

  LightGroups groups_;
  EstimatorSettings of_;
  std::vector<Rgb> sums_;  // by group, pixel and frame: radiance times photon paths
};

}  // namespace dspm
