// What each group of lights brings to the pixels of a progressive integrator: estimators of the same kind as the whole
// image's, each fed with its group's light alone. The search radius must be the same for all, as kz11's is, or parts
// would not add up to the whole. The image's own sums stay what they are without groups, to the bit, so its photons are
// gathered twice: once all together, once group by group. What shadow catchers catch is in none.
#pragma once

#include <memory>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/integrators/estimator.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/photon_map.h"
#include "dspm/math/frames.h"
#include "dspm/scene/scene.h"

namespace dspm {

class GroupEstimators {
 public:
  GroupEstimators(LightGroups groups, const EstimatorKind& kind, const EstimatorSettings& of);
  static std::size_t bytes(const LightGroups& groups, const EstimatorKind& kind, const EstimatorSettings& of) {
    return static_cast<std::size_t>(groups.count()) * kind.bytes(of);
  }

  /// Of light that needs no photons.
  void see(const std::vector<HitPointTile>& tiles);
  /// A batch of an iteration's photons. `hidden`: the radius of hidden light.
  void gather(const std::vector<HitPointTile>& tiles, const std::vector<PhotonTrace>& traces, const Scene& scene,
              float cell_size, const IterationRadius& hidden);
  void begin_iteration(int iteration);
  void end_iteration();
  /// Those of estimators.
  void forget_iteration();
  void persist(StateStream& state);

  const LightGroups& groups() const { return groups_; }
  Rgb radiance(int group, int pixel, Frame frame) const {
    return estimators_[static_cast<std::size_t>(group)]->radiance(pixel, frame);
  }
  /// Of the maps of photons.
  std::size_t map_bytes() const { return map_.bytes() + hidden_map_.bytes(); }

 private:
  LightGroups groups_;
  std::int64_t photons_;
  std::vector<std::unique_ptr<PixelEstimator>> estimators_;  // by group
  PhotonMap map_, hidden_map_;                               // of one group after the other
};

}  // namespace dspm
