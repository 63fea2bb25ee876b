#include "dspm/integrators/methods/learned_ways.h"

#include "dspm/integrators/guiding/emission_of_file.h"
#include "dspm/integrators/guiding/learn_indirect.h"
#include "dspm/integrators/possible_state.h"

namespace dspm {

LearnedWays::LearnedWays(const ProgressiveSettings& given, const Scene& scene)
    : given_(given), settings_(given), lights_(static_cast<int>(scene.lights.size())) {}

void LearnedWays::learn(const Scene& scene, const RenderSettings& render, Statistics& statistics) {
  learned_ = emission_of_file(scene, render, settings_.photon, settings_.hit_point, settings_.photons, settings_.guided,
                              statistics, settings_.may_go_on);
  apply();
}

void LearnedWays::apply() {
  settings_ = given_;
  if (learned_ == nullptr) return;
  settings_.photon.guides = &learned_->guides;
  if (learned_->goes_on)
    settings_.hit_point = going_on(settings_.hit_point), settings_.photon = without_diffuse(settings_.photon);
}

const ProgressiveSettings& LearnedWays::of_iteration(const Scene& scene, const IterationRadius& radius) {
  if (!settings_.hit_point.sample_direct) return settings_;
  const bool by_photons = settings_.hit_point.photons_as_well;
  const LearnedDirect& learned = learned_->direct;
  if (by_photons && !learned.by_rays) {
    settings_.hit_point.sample_direct = settings_.photon.rays_tell = false;
    return settings_;
  }
  direct_.emplace(scene, DirectWays{by_photons ? settings_.photons : 0, settings_.photon.guides,
                                    radius.of(learned.radius), learned.photons_a_ray});
  settings_.photon.direct = settings_.hit_point.direct = &*direct_;
  return settings_;
}

void LearnedWays::persist(StateStream& state) {
  LearnedEmission emission = learned_ != nullptr ? *learned_ : LearnedEmission();
  std::uint8_t is_learned = learned_ != nullptr;
  state.value(is_learned);
  emission.direct.persist(state);
  emission.guides.persist(state, lights_);
  state.value(emission.goes_on);
  expect_possible(is_learned <= 1 && emission.goes_on <= 1, "its record of how light is found");
  learned_ = is_learned != 0 ? std::make_shared<const LearnedEmission>(std::move(emission)) : nullptr;
  apply();
}

}  // namespace dspm
