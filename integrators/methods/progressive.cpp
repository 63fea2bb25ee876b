#include "dspm/integrators/methods/progressive.h"

#include <cmath>
#include <numeric>
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"
#include "dspm/image/image.h"
#include "dspm/integrators/caught_light.h"
#include "dspm/integrators/guiding/emission_of_file.h"
#include "dspm/integrators/guiding/learn_indirect.h"
#include "dspm/integrators/methods/group_sums.h"
#include "dspm/integrators/methods/photon_batches.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/photons/found_photons.h"
#include "dspm/integrators/photons/hidden_light.h"
#include "dspm/integrators/photons/typical_hit_point.h"
#include "dspm/integrators/possible_state.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

enum Step { kEmission, kHitPoints, kPhotons, kPhotonMap, kStatistics };

class Progressive final : public Integrator {
 public:
  Progressive(const ProgressiveSettings& settings, const Scene& scene, const RenderSettings& render,
              const EstimatorKind& estimator)
      : given_(settings),
        settings_(settings),
        render_(render),
        lights_(static_cast<int>(scene.lights.size())),
        found_(render.crop.count(), scene.frame_count(), render.outputs),
        found_by_tile_(hit_point_tile_count(render.crop)),
        group_outputs_(light_group_outputs(scene)) {
    statistics_.steps = {{"emission"}, {"hit points"}, {"photons"}, {"photon map"}, {"statistics"}};
    // How much memory photons take depends on where they start.
    if (render.memory > 0 || render.learn_at_once) learn(scene);
    batches_ = batches_within_memory(settings_, scene, render, estimator,
                                     learned_ != nullptr ? learned_->bytes_while_learning : 0);
    const EstimatorSettings of = estimator_settings(settings, scene, render, batches_);
    estimator_ = estimator.make(of);
    if (has_catchers(scene)) caught_ = estimator.make(of);
    const LightGroups groups(scene, render.outputs);
    groups_.emplace(groups, of);
    map_ = PhotonMap(groups), hidden_ = HiddenPhotons(groups);
    pixel_bytes_ = estimator.bytes(of) * (caught_ != nullptr ? 2 : 1) + GroupSums::bytes(groups, of) +
                   FoundPhotons::bytes(of.pixels, of.frames, render.outputs);
    statistics_.energy.resize(static_cast<std::size_t>(scene.frame_count()));
    statistics_.photon_batches = batches_.count();
    statistics_.bytes = bytes();
  }

  int iterations() const override { return settings_.iterations; }
  std::string settings() const override { return in_words(settings_); }

  void iterate(const Iteration& iteration) override {
    const Statistics before = statistics_;
    try {
      iterate_once(iteration.number, iteration.scene);
    } catch (...) {
      statistics_ = before;
      throw;
    }
  }

  std::vector<OutputInfo> outputs() const override {
    std::vector<OutputInfo> all = {radiance_output(), kRadiusOutput, kPhotonsOutput};
    all.insert(all.end(), group_outputs_.begin(), group_outputs_.end());
    return with_caught_light(std::move(all), caught_ != nullptr);
  }

  Image estimate(Frame frame, const std::string& output) const override {
    if (output == kRadiusOutput.name) return image_of([&](int pixel) { return Rgb(radius(pixel, frame)); });
    if (output == kPhotonsOutput.name) return image_of([&](int pixel) { return Rgb(found_.photons(pixel, frame)); });
    if (const int group = groups_->groups().of_output(output); group != LightGroups::kNone)
      return image_of([&](int pixel) { return groups_->radiance(group, pixel, frame, statistics_.iterations); });
    const PixelEstimator& estimator = estimator_of(output == kCaughtLight);
    return image_of([&](int pixel) { return estimator.radiance(pixel, frame); });
  }

  Statistics statistics() const override { return statistics_; }

  std::string why_not_in_parts() const override {
    if (estimator_->adds_up()) return {};
    return "the radii of hj09 depend on the photons that all earlier iterations found; \"string estimator\" \"kz11\" "
           "can be shared out";
  }

  bool persist(StateStream& state) override {
    statistics_.persist(state);
    for_each_estimator([&](PixelEstimator& estimator) {
      estimator.forget_iteration(), estimator.persist(state);
      expect_possible(has_possible_pixels(estimator), "its record of the pixels");
    });
    groups_->persist(state);
    shrinkage_.go_to(statistics_.iterations, settings_.alpha);
    found_.persist(state);
    found_by_tile_.persist(state);
    persist_learned(state);
    return true;
  }

 private:
  /// Checks radii and numbers of photons; what they give is checked as an image.
  bool has_possible_pixels(const PixelEstimator& estimator) const {
    for (int pixel = 0; pixel < render_.crop.count(); ++pixel)
      for (std::size_t f = 0; f < statistics_.energy.size(); ++f) {
        const std::optional<PixelStatistics> own = estimator.statistics(pixel, static_cast<Frame>(f));
        if (!own) return true;  // none has
        if (!(own->R2 >= 0 && own->N >= 0 && std::isfinite(own->N))) return false;
      }
    return true;
  }
  PixelEstimator& estimator_of(bool caught) const { return caught ? *caught_ : *estimator_; }
  template <class Fn>
  void for_each_estimator(Fn&& fn) {
    fn(*estimator_);
    if (caught_ != nullptr) fn(*caught_);
  }

  // [WG12 figure 3]
  void iterate_once(int number, const Scene& scene) {
    const auto iteration = static_cast<std::uint64_t>(number);
    if (learned_ == nullptr) learn(scene);
    shrinkage_.go_to(number, settings_.alpha);
    for_each_estimator([&](PixelEstimator& estimator) { estimator.begin_iteration(number); });
    balance_direct_light(scene);
    trace_camera_paths(scene, iteration);
    const float cell_size = mean_search_radius(scene);
    for (std::int64_t first = 0; first < batches_.photons; first += batches_.size) {
      trace_light_paths(scene, iteration, first);
      build_photon_map(scene, cell_size);
      if (first == 0) see_lights();  // not before: if memory ends, it mostly has by now, and no pixel has changed
      see_hidden_light();
      part_by_groups(first == 0);
      gather_photons();
    }
    for_each_estimator([](PixelEstimator& estimator) { estimator.end_iteration(); });
    statistics_.typical = found_by_tile_.typical(tiles_, shrunk_);
    if (settings_.hit_point.go_on) statistics_.typical.photons = 0;  // few may be all that there are
    ++statistics_.iterations;
    shrinkage_.go_to(statistics_.iterations, settings_.alpha);
  }

  void learn(const Scene& scene) {
    const StepTimer timer(statistics_.steps[kEmission]);
    learned_ = emission_of_file(scene, render_, settings_.photon, settings_.hit_point, settings_.photons,
                                settings_.guided, statistics_, settings_.may_go_on);
    settings_.photon.guides = &learned_->guides;
    go_on_if_learned();
  }

  void go_on_if_learned() {
    if (!learned_->goes_on) return;
    settings_.hit_point = going_on(settings_.hit_point), settings_.photon = without_diffuse(settings_.photon);
  }

  void persist_learned(StateStream& state) {
    LearnedEmission emission = learned_ != nullptr ? *learned_ : LearnedEmission();
    std::uint8_t is_learned = learned_ != nullptr;
    state.value(is_learned);
    emission.direct.persist(state);
    emission.guides.persist(state, lights_);
    state.value(emission.goes_on);
    expect_possible(is_learned <= 1 && emission.goes_on <= 1, "its record of how light is found");
    settings_ = given_;
    learned_ = is_learned != 0 ? std::make_shared<const LearnedEmission>(std::move(emission)) : nullptr;
    settings_.photon.guides = learned_ != nullptr ? &learned_->guides : nullptr;
    if (learned_ != nullptr) go_on_if_learned();
  }

  void balance_direct_light(const Scene& scene) {
    if (!settings_.hit_point.sample_direct) return;
    const bool by_photons = settings_.hit_point.photons_as_well;
    const LearnedDirect& learned = learned_->direct;
    if (by_photons && !learned.by_rays) {
      settings_.hit_point.sample_direct = settings_.photon.rays_tell = false;
      return;
    }
    direct_.emplace(scene, DirectWays{by_photons ? settings_.photons : 0, settings_.photon.guides,
                                      shrinkage_.of(learned.radius), learned.photons_a_ray});
    settings_.photon.direct = settings_.hit_point.direct = &*direct_;
  }

  // [WG12 4.1]
  void trace_camera_paths(const Scene& scene, std::uint64_t iteration) {
    const StepTimer timer(statistics_.steps[kHitPoints]);
    tiles_ = trace_hit_points(scene, render_, settings_.hit_point, iteration, std::move(tiles_));
    account(tiles_, statistics_);
  }

  void see_lights() {
    const StepTimer timer(statistics_.steps[kStatistics]);
    for_each_tile([this](const HitPointTile& tile, std::size_t) {
      for (const SeenLight& light : tile.seen) estimator_of(light.caught).see(light);
    });
  }

  // [WG12 4.2]
  void trace_light_paths(const Scene& scene, std::uint64_t iteration, std::int64_t first) {
    const StepTimer timer(statistics_.steps[kPhotons]);
    const std::int64_t end = std::min(first + batches_.size, batches_.photons);
    traces_ = trace_photons(scene, settings_.photon, iteration, first, end, std::move(traces_));
    account(traces_, statistics_);
  }

  /// Returns the mean search radius of the hit points, which suits the photon map's cells; the scene's radius if there
  /// are none.
  float mean_search_radius(const Scene& scene) {
    const StepTimer timer(statistics_.steps[kPhotonMap]);
    std::vector<double> sums(tiles_.size());
    shrunk_.assign(tiles_.size(), 1);
    for_each_tile([&](const HitPointTile& tile, std::size_t t) {
      double initial = 0;
      for (const HitPoint& hit : tile.hit_points) {
        sums[t] += std::sqrt(static_cast<double>(estimator_of(hit.caught).search_radius2(hit)));
        initial += static_cast<double>(hit.radius);
      }
      if (initial > 0) shrunk_[t] = sums[t] / initial;
    });
    std::size_t count = 0;
    for (const HitPointTile& tile : tiles_) count += tile.hit_points.size();
    if (count == 0) return scene.radius;
    return static_cast<float>(std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(count));
  }

  void build_photon_map(const Scene& scene, float cell_size) {
    const StepTimer timer(statistics_.steps[kPhotonMap]);
    map_.build(traces_, scene.frame_count(), cell_size);
    hidden_.build(traces_, scene.frame_count(), cell_size);
  }

  /// Adds hidden light. Its radius shrinks like kz11's for both estimators, so that it is linear in the photons and can
  /// be added as seen light.
  void see_hidden_light() {
    const StepTimer timer(statistics_.steps[kStatistics]);
    std::vector<GatherCounts> counts(tiles_.size());
    for_each_tile([&](const HitPointTile& tile, std::size_t t) {
      for (const HitPoint& hit : tile.glossy)
        gather_hidden(
            hit, tile, hidden_, shrinkage_.squared(hit), counts[t], [&](FrameSet frames, const Rgb& radiance) {
              estimator_of(hit.caught).see({frames, radiance / static_cast<float>(settings_.photons), hit.pixel});
            });
    });
    account(counts, statistics_);
  }

  // [WG12 4.3]
  void gather_photons() {
    const StepTimer timer(statistics_.steps[kStatistics]);
    std::vector<GatherCounts> counts(tiles_.size());
    for_each_tile([&](const HitPointTile& tile, std::size_t t) {
      for (const HitPoint& hit : tile.hit_points) {
        if (found_.are_wanted() && !hit.indirect) find_photons(hit, tile);
        estimator_of(hit.caught).gather_at(hit, tile, map_, counts[t]);
      }
    });
    account(counts, statistics_);
    found_by_tile_.add(counts);
    statistics_.bytes = std::max(statistics_.bytes, bytes());
  }

  void part_by_groups(bool first) {
    if (groups_->groups().count() == 0) return;
    const StepTimer timer(statistics_.steps[kStatistics]);
    if (first) groups_->see(tiles_);
    groups_->gather(tiles_, map_, *estimator_, hidden_, shrinkage_);
  }

  template <class Value>
  Image image_of(Value&& value) const {
    Image image(render_.crop.width(), render_.crop.height());
    parallel_for(render_.crop.count(), 1 << 12, [&](std::int64_t pixel) {
      image.pixels[static_cast<std::size_t>(pixel)] = value(static_cast<int>(pixel));
    });
    return image;
  }

  void find_photons(const HitPoint& hit, const HitPointTile& tile) {
    const PixelEstimator& estimator = estimator_of(hit.caught);
    found_.gather_at(hit, tile, map_, estimator.search_radius2(hit),
                     [&](Frame frame) { return estimator.search_radius2_in(frame, hit); });
  }

  /// The radius for the next iteration.
  float radius(int pixel, Frame frame) const {
    std::optional<PixelStatistics> own = estimator_->statistics(pixel, frame);
    if (own && own->R2 == 0 && caught_ != nullptr) own = caught_->statistics(pixel, frame);
    return own ? std::sqrt(own->R2) : shrinkage_.of(found_.initial_radius(pixel, frame));
  }

  template <class Fn>
  void for_each_tile(Fn&& fn) const {
    parallel_for(static_cast<std::int64_t>(tiles_.size()), 1,
                 [&](std::int64_t t) { fn(tiles_[static_cast<std::size_t>(t)], static_cast<std::size_t>(t)); });
  }

  std::size_t bytes() const {
    return pixel_bytes_ + map_.bytes() + hidden_.bytes() + bytes_of(traces_) + bytes_of(tiles_);
  }

  const ProgressiveSettings given_;
  ProgressiveSettings settings_;  // with what was learned
  RenderSettings render_;
  PhotonBatches batches_;
  int lights_;
  std::shared_ptr<const LearnedEmission> learned_;  // null before the first iteration
  std::optional<DirectBalance> direct_;             // of the iteration
  FoundPhotons found_;
  FoundByTile found_by_tile_;
  std::vector<double> shrunk_;  // by tile: radius over initial radius
  std::vector<OutputInfo> group_outputs_;
  std::unique_ptr<PixelEstimator> estimator_;
  std::unique_ptr<PixelEstimator> caught_;  // of the light on shadow catchers; null: the scene has none
  std::optional<GroupSums> groups_;         // of lights; made together with the estimator
  std::size_t pixel_bytes_ = 0;
  std::vector<HitPointTile> tiles_;
  std::vector<PhotonTrace> traces_;
  PhotonMap map_;
  HiddenPhotons hidden_;
  IterationRadius shrinkage_;  // of hidden light's radius, and of kz11's
  Statistics statistics_;
};

}  // namespace

std::unique_ptr<Integrator> make_progressive(const ProgressiveSettings& settings, const Scene& scene,
                                             const RenderSettings& render, const EstimatorKind& estimator) {
  return std::make_unique<Progressive>(settings, scene, render, estimator);
}

}  // namespace dspm
