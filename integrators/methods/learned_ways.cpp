#include "dspm/integrators/methods/learned_ways.h"

#include <algorithm>

#include "dspm/integrators/guiding/emission_of_file.h"
#include "dspm/integrators/methods/cut_light.h"
#include "dspm/integrators/photons/shares_of_light.h"
#include "dspm/integrators/possible_state.h"

namespace dspm {

namespace {

/// Photons bring all that media scatter.
ProgressiveSettings suited_to(const Scene& scene, ProgressiveSettings settings) {
  if (!scene.media.empty()) settings.may_choose = false;
  return settings;
}

}  // namespace

LearnedWays::LearnedWays(const ProgressiveSettings& given, const Scene& scene)
    : given_(suited_to(scene, given)), settings_(given_), lights_(static_cast<int>(scene.lights.size())) {}

void LearnedWays::learn(const Scene& scene, const RenderSettings& render, Statistics& statistics) {
  learned_ = emission_of_file(scene, render, settings_.photon, settings_.hit_point, settings_.photons, settings_.guided,
                              statistics, settings_.may_choose);
  apply();
}

void LearnedWays::apply() {
  settings_ = given_;
  if (learned_ == nullptr) return;
  settings_.photon.guides = &learned_->guides;
  if (learned_->traced > 0) settings_.traced = std::min<std::int64_t>(learned_->traced, settings_.photons);
  if (learned_->bring == PhotonsBring::nothing) settings_.traced = 0;
  if (settings_.traced > 0)
    settings_.photon.flux = static_cast<float>(settings_.photons) / static_cast<float>(settings_.traced);
  if (learned_->bring == PhotonsBring::all) return;
  settings_.photon = caustics_alone(settings_.photon), settings_.hit_point.photons_as_well = false;
  settings_.hit_point =
      learned_->bring == PhotonsBring::nothing ? finding_all(settings_.hit_point) : going_on(settings_.hit_point);
}

const ProgressiveSettings& LearnedWays::of_iteration(const Scene& scene, const IterationRadius& radius) {
  if (!settings_.hit_point.sample_direct) return settings_;
  const bool by_photons = settings_.hit_point.photons_as_well;
  const LearnedDirect& learned = learned_->direct;
  if (by_photons && !learned.by_rays) {
    settings_.hit_point.sample_direct = settings_.photon.rays_tell = false;
    return settings_;
  }
  direct_.emplace(scene, DirectWays{by_photons ? settings_.traced : 0, settings_.photon.guides,
                                    radius.of(learned.radius), learned.photons_a_ray, settings_.hit_point.go_on});
  settings_.photon.direct = settings_.hit_point.direct = &*direct_;
  return settings_;
}

void LearnedWays::start_statistics(const Scene& scene, const RenderSettings& render, Statistics& statistics) const {
  if (given_.may_choose) statistics.cut_light = no_cut_light(scene, render);
}

void LearnedWays::count_iteration(const Scene& scene, const RenderSettings& render, int number,
                                  Statistics& statistics) const {
  const bool goes_on = settings_.hit_point.go_on || settings_.traced == 0;
  if (!goes_on) return;
  statistics.typical.photons = 0;  // few may be all that there are
  if (!statistics.cut_light.empty())
    count_cut_light(scene, render, {settings_.hit_point.max_depth, true}, static_cast<std::uint64_t>(number),
                    statistics);
}

void LearnedWays::persist(StateStream& state) {
  LearnedEmission emission = learned_ != nullptr ? *learned_ : LearnedEmission();
  std::uint8_t is_learned = learned_ != nullptr;
  state.value(is_learned);
  emission.direct.persist(state);
  emission.guides.persist(state, lights_);
  state.value(emission.bring);
  state.value(emission.traced);
  expect_possible(is_learned <= 1 && emission.bring <= PhotonsBring::nothing && emission.traced >= 0 &&
                      (emission.bring != PhotonsBring::caustics || emission.traced > 0),
                  "its record of how light is found");
  learned_ = is_learned != 0 ? std::make_shared<const LearnedEmission>(std::move(emission)) : nullptr;
  apply();
}

}  // namespace dspm
