#include "dspm/integrators/methods/progressive.h"

#include <algorithm>
#include <optional>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"
#include "dspm/image/image.h"
#include "dspm/integrators/methods/learned_ways.h"
#include "dspm/integrators/methods/photon_batches.h"
#include "dspm/integrators/methods/pixel_sinks.h"
#include "dspm/integrators/photons/typical_hit_point.h"
#include "dspm/integrators/waves/traced_paths.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

class Progressive final : public Integrator {
  enum Step { kEmission, kHitPoints, kPhotons, kPhotonMap, kStatistics };

 public:
  Progressive(const ProgressiveSettings& settings, const Scene& scene, const RenderSettings& render,
              const EstimatorKind& estimator)
      : render_(render),
        ways_(settings, scene),
        paths_(settings.device, render.device == Device::automatic),
        typical_(hit_point_tile_count(render.crop)) {
    statistics_.steps = {{"emission"}, {"hit points"}, {"photons"}, {"photon map"}, {"statistics"}};
    ways_.start_statistics(scene, render, statistics_);
    // How much memory photons take depends on where they start.
    if (render.memory > 0 || render.learn_at_once) learn(scene);
    batches_ = batches_within_memory(ways_.settings(), scene, render, estimator, ways_.bytes());
    const EstimatorSettings of = estimator_settings(settings, scene, render, batches_, &radius_);
    sinks_ = PixelSinks(of, estimator, scene, render);
    sink_bytes_ = PixelSinks::bytes(of, estimator, scene, render);
    const LightGroups groups(scene, render.outputs);
    map_ = PhotonMap(groups), hidden_ = HiddenPhotons(groups);
    statistics_.energy.resize(static_cast<std::size_t>(scene.frame_count()));
    statistics_.photon_batches = batches_.count();
    statistics_.bytes = bytes();
  }

  int iterations() const override { return ways_.settings().iterations; }
  std::string settings() const override { return in_words(ways_.settings()); }

  void iterate(const Iteration& iteration) override {
    const Statistics before = statistics_;
    try {
      iterate_once(iteration);
    } catch (...) {
      statistics_ = before;
      throw;
    }
  }

  std::vector<OutputInfo> outputs() const override {
    std::vector<OutputInfo> infos;
    for (const PixelOutput& output : pixel_outputs()) infos.push_back(output.info);
    return infos;
  }

  Image estimate(Frame frame, const std::string& name) const override {
    const std::vector<PixelOutput> all = pixel_outputs();
    const auto named =
        std::find_if(all.begin(), all.end(), [&](const auto& output) { return output.info.name == name; });
    return image_of(named != all.end() ? *named : all.front(), frame);
  }

  Statistics statistics() const override { return statistics_; }

  std::string why_not_in_parts() const override {
    if (sinks_.estimators.image->adds_up()) return {};
    return "the radii of hj09 depend on the photons that all earlier iterations found; \"string estimator\" \"kz11\" "
           "can be shared out";
  }

  bool persist(StateStream& state) override {
    statistics_.persist(state);
    for (const auto& sink : sinks_.list) sink->persist(state);
    go_to_radius_of(statistics_.iterations);
    typical_.persist(state);
    ways_.persist(state);
    return true;
  }

 private:
  void iterate_once(const Iteration& iteration) {
    if (!ways_.are_known()) learn(iteration.scene);
    go_to_radius_of(iteration.number);
    iteration.for_each_moment(
        [&](const Scene& scene, const MomentPixels& pixels) { show_moment(scene, pixels, iteration.number); });
    for (const auto& sink : sinks_.list) sink->end_iteration();
    statistics_.typical = typical_.typical(tiles_);
    ways_.count_iteration(iteration.scene, render_, iteration.number, statistics_);
    ++statistics_.iterations;
    go_to_radius_of(statistics_.iterations);
  }

  // [WG12 4] Photons and hit points meet in the same moment. Of several, each has its part of the photons, unless there are
  // fewer of them.
  void show_moment(const Scene& scene, const MomentPixels& pixels, int number) {
    const ProgressiveSettings& how = ways_.of_iteration(scene, radius_);
    HitPointSettings hit_point = how.hit_point;
    hit_point.pixels = pixels;
    trace_camera_paths(scene, hit_point, number);
    const float cell_size = mean_search_radius(scene);
    const bool shared_out = how.traced >= pixels.count;
    const std::int64_t begin = shared_out ? how.traced * pixels.moment / pixels.count : 0,
                       end = shared_out ? how.traced * (pixels.moment + 1) / pixels.count : how.traced;
    const double share = end > begin ? static_cast<double>(end - begin) / static_cast<double>(how.traced) : 1;
    PhotonSettings photon = how.photon;
    photon.flux = static_cast<float>(photon.flux / share);
    for (std::int64_t first = begin; first == begin || first < end; first += batches_.size) {
      trace_light_paths(scene, photon, number, first, std::min(first + batches_.size, end));
      for (PhotonTrace& trace : traces_)
        for (EnergyBalance& energy : trace.energy) energy = energy * share;  // of that of all photons
      account(traces_, statistics_);
      build_photon_map(scene, cell_size);
      if (first == begin) see_lights();  // not before: if memory ends, it mostly has by now, and no pixel has changed
      gather_photons(scene, pixels.moment == 0);
    }
  }

  void learn(const Scene& scene) {
    const StepTimer timer(statistics_.steps[kEmission]);
    ways_.learn(scene, render_, statistics_);
  }

  void go_to_radius_of(int iteration) { radius_.go_to(iteration, ways_.settings().alpha); }

  // [WG12 4.1]
  void trace_camera_paths(const Scene& scene, const HitPointSettings& settings, int iteration) {
    const StepTimer timer(statistics_.steps[kHitPoints]);
    const auto number = static_cast<std::uint64_t>(iteration);
    tiles_ = paths_.hit_points(scene, render_, settings, number, std::move(tiles_));
    account(tiles_, statistics_);
    statistics_.why_off_gpu = paths_.why_off_gpu();
  }

  /// Returns what suits the photon map's cells.
  float mean_search_radius(const Scene& scene) {
    const StepTimer timer(statistics_.steps[kPhotonMap]);
    const double mean = typical_.mean_radius(
        tiles_, [&](const HitPoint& hit) { return sinks_.estimators.of(hit).search_radius2(hit); });
    return mean > 0 ? static_cast<float>(mean) : scene.radius;
  }

  // [WG12 4.2]
  void trace_light_paths(const Scene& scene, const PhotonSettings& settings, int iteration, std::int64_t first,
                         std::int64_t end) {
    const StepTimer timer(statistics_.steps[kPhotons]);
    const auto number = static_cast<std::uint64_t>(iteration);
    traces_ = paths_.photons(scene, settings, number, first, end, std::move(traces_));
  }

  void build_photon_map(const Scene& scene, float cell_size) {
    const StepTimer timer(statistics_.steps[kPhotonMap]);
    map_.build(traces_, scene.frame_count(), cell_size);
    hidden_.build(traces_, scene.frame_count(), cell_size);
    if (!scene.media.empty()) in_media_.build(traces_);
  }

  void see_lights() {
    const StepTimer timer(statistics_.steps[kStatistics]);
    for (const auto& sink : sinks_.list) sink->see(tiles_);
  }

  // [WG12 4.3] Those that look at the estimators' radii come before them: hj09 shrinks them as it gathers.
  void gather_photons(const Scene& scene, bool is_first_part) {
    const StepTimer timer(statistics_.steps[kStatistics]);
    BatchCounts counts(tiles_.size());
    const PixelEstimator& image = *sinks_.estimators.image;
    const std::optional<FluxOfPoints> flux =
        image.takes_flux()
            ? paths_.flux(scene, tiles_, map_, [&](const HitPoint& hit) { return image.search_radius2(hit); })
            : std::nullopt;
    for (auto sink = sinks_.list.rbegin(); sink != sinks_.list.rend(); ++sink)
      (*sink)->gather({tiles_, map_, hidden_, in_media_, flux ? &*flux : nullptr}, counts);
    account(counts.hidden, statistics_);
    account(counts.photons, statistics_);
    typical_.add(counts.photons, is_first_part);
    statistics_.bytes = std::max(statistics_.bytes, bytes());
  }

  std::vector<PixelOutput> pixel_outputs() const {
    std::vector<PixelOutput> all;
    for (const auto& sink : sinks_.list)
      for (PixelOutput& output : sink->outputs(statistics_.iterations)) all.push_back(std::move(output));
    return all;
  }

  Image image_of(const PixelOutput& output, Frame frame) const {
    Image image(render_.crop.width(), render_.crop.height());
    parallel_for(render_.crop.count(), 1 << 12, [&](std::int64_t pixel) {
      image.pixels[static_cast<std::size_t>(pixel)] = output.value(static_cast<int>(pixel), frame);
    });
    return image;
  }

  std::size_t bytes() const {
    return sink_bytes_ + map_.bytes() + hidden_.bytes() + in_media_.bytes() + bytes_of(traces_) + bytes_of(tiles_);
  }

  RenderSettings render_;
  LearnedWays ways_;
  TracedPaths paths_;
  PhotonBatches batches_;
  IterationRadius radius_;  // of hidden light and of kz11: the next iteration's
  PixelSinks sinks_;
  std::size_t sink_bytes_ = 0;
  TypicalHitPoints typical_;
  std::vector<HitPointTile> tiles_;
  std::vector<PhotonTrace> traces_;
  PhotonMap map_;
  HiddenPhotons hidden_;
  MediumPhotons in_media_;
  Statistics statistics_;
};

}  // namespace

std::unique_ptr<Integrator> make_progressive(const ProgressiveSettings& settings, const Scene& scene,
                                             const RenderSettings& render, const EstimatorKind& estimator) {
  return std::make_unique<Progressive>(settings, scene, render, estimator);
}

}  // namespace dspm
