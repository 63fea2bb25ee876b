// Integrator "dsppm" "integer iterations" 400 "integer photons" 300000
//
// Dynamic stochastic progressive photon mapping [WG12]: all frames together. Camera and photon paths that meet nothing
// which differs between frames are traced once; every frame converges to what sppm gives for it alone. Parameters: see
// progressive_settings.cpp.
#include "integrators/dsppm/dsppm.h"

#include "core/parallel.h"
#include "integrators/progressive_settings.h"

namespace dspm {
namespace {

enum Step { kHitPoints, kPhotons, kPhotonMap, kStatistics };

class Dsppm final : public Integrator {
 public:
  Dsppm(const ProgressiveSettings& settings, const Scene& scene, const RenderSettings& render)
      : settings_(settings), scene_(scene), render_(render) {
    const EstimatorSettings of{render.crop.count(), scene.frame_count(), settings.photons, settings.alpha};
    estimator_ = settings.kz11 ? make_kz11(of) : make_hj09(of);
    statistics_.steps = {{"hit points"}, {"photons"}, {"photon map"}, {"statistics"}};
    statistics_.energy.resize(static_cast<std::size_t>(scene.frame_count()));
    statistics_.bytes = bytes();
  }

  int iterations() const override { return settings_.iterations; }
  std::string settings() const override { return in_words(settings_); }

  void iterate(int iteration) override {
    trace_camera_paths(static_cast<std::uint64_t>(iteration));
    trace_light_paths(static_cast<std::uint64_t>(iteration));
    {
      const StepTimer timer(statistics_.steps[kPhotonMap]);
      map_.build(traces_,
                 mean_search_radius(
                     tiles_, [&](const HitPoint& hit) { return estimator_->search_radius2(hit); }, scene_.radius));
    }
    update_statistics();
    ++statistics_.iterations;
  }

  Image estimate(Frame frame) const override {
    Image image(render_.crop.width(), render_.crop.height());
    for (int pixel = 0; pixel < render_.crop.count(); ++pixel)
      image.pixels[static_cast<std::size_t>(pixel)] = estimator_->radiance(pixel, frame);
    return image;
  }

  const PixelStatistics* pixel_statistics(int pixel, Frame frame) const override {
    return estimator_->statistics(pixel, frame);
  }

  Statistics statistics() const override { return statistics_; }

 private:
  // [WG12 4.1]
  void trace_camera_paths(std::uint64_t iteration) {
    const StepTimer timer(statistics_.steps[kHitPoints]);
    tiles_ = trace_hit_points(scene_, render_, settings_.hit_point, iteration, std::move(tiles_));
    account(tiles_, statistics_);
  }

  // [WG12 4.2]
  void trace_light_paths(std::uint64_t iteration) {
    const StepTimer timer(statistics_.steps[kPhotons]);
    traces_ = trace_photons(scene_, settings_.photon, iteration, settings_.photons, std::move(traces_));
    account(traces_, statistics_);
  }

  // [WG12 4.3]
  void update_statistics() {
    const StepTimer timer(statistics_.steps[kStatistics]);
    std::vector<GatherCounts> counts(tiles_.size());
    parallel_for(static_cast<std::int64_t>(tiles_.size()), 1, [&](std::int64_t t) {
      const HitPointTile& tile = tiles_[static_cast<std::size_t>(t)];
      for (const SeenLight& light : tile.seen) estimator_->see(light);
      for (const HitPoint& hit : tile.hit_points)
        estimator_->gather_at(hit, tile.scattering_of(hit), map_, counts[static_cast<std::size_t>(t)]);
    });
    estimator_->end_iteration();
    account(counts, statistics_);
    statistics_.bytes = std::max(statistics_.bytes, bytes());
  }

  std::size_t bytes() const { return estimator_->bytes() + map_.bytes() + bytes_of(tiles_) + bytes_of(traces_); }

  ProgressiveSettings settings_;
  const Scene& scene_;
  RenderSettings render_;
  std::unique_ptr<PixelEstimator> estimator_;
  std::vector<HitPointTile> tiles_;
  std::vector<PhotonTrace> traces_;
  PhotonMap map_;
  Statistics statistics_;
};

}  // namespace

std::unique_ptr<Integrator> make_dsppm(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  const ProgressiveSettings settings = read_progressive_settings(params, render);
  return std::make_unique<Dsppm>(settings, scene, render);
}

}  // namespace dspm
