#include "dspm/integrators/progressive.h"

#include <cmath>
#include <new>
#include <numeric>
#include <optional>
#include <string>

#include "dspm/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/integrators/hidden_light.h"
#include "dspm/integrators/memory_needs.h"
#include "dspm/math/frames.h"
#include "dspm/scene/scene.h"
#include "dspm/system/cancellation.h"
#include "dspm/system/parallel.h"
#include "dspm/system/state_in_memory.h"

namespace dspm {
namespace {

enum Step { kHitPoints, kPhotons, kPhotonMap, kStatistics };

// More and smaller batches cost time and save little: most of the memory is the pixels' by then.
constexpr std::int64_t kMostBatches = 16, kLeastPaths = 4096;

constexpr double kLongGathering = 5;  // seconds that a Ctrl-C is not to wait for

EstimatorSettings estimator_settings(const ProgressiveSettings& s, const Scene& scene, const RenderSettings& render,
                                     std::int64_t batch) {
  return {render.crop.count(), scene.frame_count(), s.photons, s.alpha, batch < s.photons};
}

/// Of what persist() saves of the pixels.
std::size_t copy_bytes(EstimatorSettings of, const EstimatorKind& estimator) {
  of.batched = false;
  return estimator.bytes(of);
}

/// How many photon paths of an iteration are traced at a time: as many as there is memory for.
std::int64_t batch_within_memory(const ProgressiveSettings& settings, const Scene& scene, const RenderSettings& render,
                                 const EstimatorKind& estimator) {
  if (render.memory == 0) return settings.photons;
  const double a_path = bytes_a_photon_path(scene, settings.photon);
  MemoryNeeds needs, least;
  needs.hit_points = hit_point_bytes(scene, render, settings.hit_point);
  for (std::int64_t batches = 1; batches <= kMostBatches; ++batches) {
    const std::int64_t batch = (settings.photons + batches - 1) / batches;
    if (batches > 1 && batch < kLeastPaths) break;
    needs.photons = static_cast<std::size_t>(a_path * static_cast<double>(batch));
    const EstimatorSettings of = estimator_settings(settings, scene, render, batch);
    needs.pixels = estimator.bytes(of) + (of.batched ? copy_bytes(of, estimator) : 0);
    if (needs.total() <= render.memory) return batch;
    if (batches == 1 || needs.total() < least.total()) least = needs;
  }
  throw NotEnoughMemory(least);
}

class Progressive final : public Integrator {
 public:
  Progressive(const ProgressiveSettings& settings, const Scene& scene, const RenderSettings& render,
              const EstimatorKind& estimator)
      : settings_(settings),
        scene_(scene),
        render_(render),
        batch_(batch_within_memory(settings, scene, render, estimator)),
        kind_(estimator),
        estimator_settings_(estimator_settings(settings, scene, render, batch_)) {
    estimator_ = kind_.make(estimator_settings_);
    estimator_bytes_ = kind_.bytes(estimator_settings_);
    statistics_.steps = {{"hit points"}, {"photons"}, {"photon map"}, {"statistics"}};
    statistics_.energy.resize(static_cast<std::size_t>(scene.frame_count()));
    statistics_.photon_batches = static_cast<int>((settings.photons + batch_ - 1) / batch_);
    statistics_.bytes = bytes();
  }

  int iterations() const override { return settings_.iterations; }
  std::string settings() const override { return in_words(settings_); }

  void iterate(int iteration) override {
    const Statistics before = statistics_;
    std::optional<Cancellable> nothing_is_lost(std::in_place);
    try {
      const float cell_size = trace_until_first_gather(static_cast<std::uint64_t>(iteration));
      copy_pixels();
      if (statistics_.iterations > 0 && !pixels_before_) nothing_is_lost.reset();
      gather_all(static_cast<std::uint64_t>(iteration), cell_size);
    } catch (...) {
      if (nothing_is_lost) go_back_to(before);
      throw;
    }
    pixels_before_.reset();
  }

  Image estimate(Frame frame) const override {
    Image image(render_.crop.width(), render_.crop.height());
    for (int pixel = 0; pixel < render_.crop.count(); ++pixel)
      image.pixels[static_cast<std::size_t>(pixel)] = estimator_->radiance(pixel, frame);
    return image;
  }

  std::optional<PixelStatistics> pixel_statistics(int pixel, Frame frame) const override {
    return estimator_->statistics(pixel, frame);
  }

  Statistics statistics() const override { return statistics_; }

  bool persist(StateStream& state) override {
    statistics_.persist(state);
    estimator_->persist(state);
    hidden_radius_.persist(state);
    return true;
  }

 private:
  /// Changes no pixel. Returns the cell size of the photon maps.
  float trace_until_first_gather(std::uint64_t iteration) {
    trace_camera_paths(iteration);
    const float cell_size = mean_search_radius();
    trace_light_paths(iteration, 0);
    build_photon_map(cell_size);
    return cell_size;
  }

  void gather_all(std::uint64_t iteration, float cell_size) {
    see_lights();
    see_hidden_light();
    gather_photons();
    for (std::int64_t first = batch_; first < settings_.photons; first += batch_) {
      trace_light_paths(iteration, first);
      build_photon_map(cell_size);
      see_hidden_light();
      gather_photons();
    }
    estimator_->end_iteration();
    hidden_radius_.end_iteration(settings_.alpha);
    ++statistics_.iterations;
  }

  /// So that gathering may be given up. Not where it is short, and not where the copy would be most of the memory; room
  /// for it is part of the plan where photons come in batches.
  void copy_pixels() {
    if (statistics_.iterations == 0) return;  // before the first iteration there is nothing to keep
    const StepTimer timer(statistics_.steps[kStatistics]);
    const std::size_t copy = copy_bytes(estimator_settings_, kind_);
    const bool fits = render_.memory == 0 || bytes() + copy <= render_.memory;
    const bool is_short = statistics_.steps[kStatistics].seconds < kLongGathering * statistics_.iterations;
    if (!is_batched() && (is_short || !fits || copy > photon_bytes())) return;
    try {
      pixels_before_ = state_of(*estimator_);
    } catch (const std::bad_alloc&) {  // then it is not given up
    }
  }

  void go_back_to(const Statistics& before) {
    statistics_ = before;
    if (statistics_.iterations == 0) {
      estimator_.reset();
      estimator_ = kind_.make(estimator_settings_);
    } else if (pixels_before_) {
      LoadedState state(*pixels_before_);
      estimator_->persist(state);
      estimator_->forget_iteration();
      pixels_before_.reset();
    }
  }

  bool is_batched() const { return batch_ < settings_.photons; }

  // [WG12 4.1]
  void trace_camera_paths(std::uint64_t iteration) {
    const StepTimer timer(statistics_.steps[kHitPoints]);
    tiles_ = trace_hit_points(scene_, render_, settings_.hit_point, iteration, std::move(tiles_));
    account(tiles_, statistics_);
  }

  void see_lights() {
    const StepTimer timer(statistics_.steps[kStatistics]);
    for_each_tile([this](const HitPointTile& tile, std::size_t) {
      for (const SeenLight& light : tile.seen) estimator_->see(light);
    });
  }

  // [WG12 4.2]
  void trace_light_paths(std::uint64_t iteration, std::int64_t first) {
    const StepTimer timer(statistics_.steps[kPhotons]);
    const std::int64_t end = std::min<std::int64_t>(first + batch_, settings_.photons);
    traces_ = trace_photons(scene_, settings_.photon, iteration, first, end, std::move(traces_));
    account(traces_, statistics_);
  }

  /// What the photon map's cells should be like.
  float mean_search_radius() {
    const StepTimer timer(statistics_.steps[kPhotonMap]);
    std::vector<double> sums(tiles_.size());
    for_each_tile([&](const HitPointTile& tile, std::size_t t) {
      for (const HitPoint& hit : tile.hit_points)
        sums[t] += std::sqrt(static_cast<double>(estimator_->search_radius2(hit)));
    });
    std::size_t count = 0;
    for (const HitPointTile& tile : tiles_) count += tile.hit_points.size();
    if (count == 0) return scene_.radius;
    return static_cast<float>(std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(count));
  }

  void build_photon_map(float cell_size) {
    const StepTimer timer(statistics_.steps[kPhotonMap]);
    map_.build(traces_, scene_.frame_count(), cell_size);
    hidden_map_.build(traces_, scene_.frame_count(), cell_size, &PhotonTrace::hidden);
  }

  /// Its radius shrinks as kz11's whatever the estimator, so that it is linear in the photons and can be added as seen.
  void see_hidden_light() {
    const StepTimer timer(statistics_.steps[kStatistics]);
    std::vector<GatherCounts> counts(tiles_.size());
    for_each_tile([&](const HitPointTile& tile, std::size_t t) {
      for (const HitPoint& hit : tile.glossy)
        gather_hidden(hit, tile, hidden_map_, hidden_radius_.squared(hit), counts[t],
                      [&](FrameSet frames, const Rgb& radiance) {
                        estimator_->see({hit.pixel, frames, radiance / static_cast<float>(settings_.photons)});
                      });
    });
    account(counts, statistics_);
  }

  // [WG12 4.3]
  void gather_photons() {
    const StepTimer timer(statistics_.steps[kStatistics]);
    std::vector<GatherCounts> counts(tiles_.size());
    for_each_tile([&](const HitPointTile& tile, std::size_t t) {
      for (const HitPoint& hit : tile.hit_points) estimator_->gather_at(hit, tile, map_, counts[t]);
    });
    account(counts, statistics_);
    statistics_.bytes = std::max(statistics_.bytes, bytes());
  }

  template <class Fn>
  void for_each_tile(Fn&& fn) const {
    parallel_for(static_cast<std::int64_t>(tiles_.size()), 1,
                 [&](std::int64_t t) { fn(tiles_[static_cast<std::size_t>(t)], static_cast<std::size_t>(t)); });
  }

  std::size_t bytes() const {
    return estimator_bytes_ + (pixels_before_ ? pixels_before_->capacity() : 0) + photon_bytes() + bytes_of(tiles_);
  }
  std::size_t photon_bytes() const { return map_.bytes() + hidden_map_.bytes() + bytes_of(traces_); }

  ProgressiveSettings settings_;
  const Scene& scene_;
  RenderSettings render_;
  std::int64_t batch_;  // photon paths traced at a time
  EstimatorKind kind_;
  EstimatorSettings estimator_settings_;
  std::unique_ptr<PixelEstimator> estimator_;
  std::size_t estimator_bytes_ = 0;
  std::optional<std::string> pixels_before_;  // the iteration
  std::vector<HitPointTile> tiles_;
  std::vector<PhotonTrace> traces_;
  PhotonMap map_, hidden_map_;
  IterationRadius hidden_radius_;
  Statistics statistics_;
};

}  // namespace

std::unique_ptr<Integrator> make_progressive(const ProgressiveSettings& settings, const Scene& scene,
                                             const RenderSettings& render, const EstimatorKind& estimator) {
  return std::make_unique<Progressive>(settings, scene, render, estimator);
}

}  // namespace dspm
