#include "dspm/integrators/group_estimators.h"

#include <utility>

#include "dspm/integrators/hidden_light.h"
#include "dspm/system/parallel.h"

namespace dspm {

GroupEstimators::GroupEstimators(LightGroups groups, const EstimatorKind& kind, const EstimatorSettings& of)
    : groups_(std::move(groups)), photons_(of.photons) {
  for (int group = 0; group < groups_.count(); ++group) estimators_.push_back(kind.make(of));
}

void GroupEstimators::see(const std::vector<HitPointTile>& tiles) {
  if (estimators_.empty()) return;
  parallel_for(static_cast<std::int64_t>(tiles.size()), 1, [&](std::int64_t t) {
    for (const SeenLight& light : tiles[static_cast<std::size_t>(t)].seen)
      if (const int group = groups_.of_light(light.light); group != LightGroups::kNone && !light.caught)
        estimators_[static_cast<std::size_t>(group)]->see(light);
  });
}

void GroupEstimators::gather(const std::vector<HitPointTile>& tiles, const std::vector<PhotonTrace>& traces,
                             const Scene& scene, float cell_size, const IterationRadius& hidden) {
  for (int group = 0; group < groups_.count(); ++group) {
    PixelEstimator& estimator = *estimators_[static_cast<std::size_t>(group)];
    const PhotonsOfGroup only{groups_, group};
    map_.build(traces, scene.frame_count(), cell_size, &PhotonTrace::photons, &only);
    hidden_map_.build(traces, scene.frame_count(), cell_size, &PhotonTrace::hidden, &only);
    parallel_for(static_cast<std::int64_t>(tiles.size()), 1, [&](std::int64_t t) {
      const HitPointTile& tile = tiles[static_cast<std::size_t>(t)];
      GatherCounts not_counted;
      for (const HitPoint& hit : tile.glossy) {
        if (hit.caught) continue;
        gather_hidden(hit, tile, hidden_map_, hidden.squared(hit), not_counted,
                      [&](FrameSet frames, const Rgb& radiance) {
                        estimator.see({frames, radiance / static_cast<float>(photons_), hit.pixel});
                      });
      }
      for (const HitPoint& hit : tile.hit_points)
        if (!hit.caught) estimator.gather_at(hit, tile, map_, not_counted);
    });
  }
}

void GroupEstimators::begin_iteration(int iteration) {
  for (const auto& estimator : estimators_) estimator->begin_iteration(iteration);
}

void GroupEstimators::end_iteration() {
  for (const auto& estimator : estimators_) estimator->end_iteration();
}

void GroupEstimators::forget_iteration() {
  for (const auto& estimator : estimators_) estimator->forget_iteration();
}

void GroupEstimators::persist(StateStream& state) {
  for (const auto& estimator : estimators_) estimator->persist(state);
}

}  // namespace dspm
