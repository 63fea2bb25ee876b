#include "dspm/integrators/methods/pixel_sinks.h"

#include "dspm/integrators/caught_light.h"
#include "dspm/integrators/methods/found_photons.h"
#include "dspm/integrators/methods/group_sums.h"

namespace dspm {

PixelSinks::PixelSinks(const EstimatorSettings& of, const EstimatorKind& kind, const Scene& scene,
                       const RenderSettings& render) {
  const auto add_estimator = [&](bool caught) {
    EstimatorSettings own = of;
    own.caught = caught;
    std::unique_ptr<PixelEstimator> estimator = kind.make(own);
    (caught ? estimators.caught : estimators.image) = estimator.get();
    list.push_back(std::move(estimator));
  };
  add_estimator(false);
  if (has_catchers(scene)) add_estimator(true);
  list.push_back(std::make_unique<GroupSums>(of, *estimators.image, scene, render.outputs));
  list.push_back(std::make_unique<FoundPhotons>(of, estimators, render.outputs));
}

std::size_t PixelSinks::bytes(const EstimatorSettings& of, const EstimatorKind& kind, const Scene& scene,
                              const RenderSettings& render) {
  return kind.bytes(of) * (has_catchers(scene) ? 2 : 1) + GroupSums::bytes(of, LightGroups(scene, render.outputs)) +
         FoundPhotons::bytes(of, render.outputs);
}

}  // namespace dspm
