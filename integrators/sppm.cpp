// Integrator "sppm" "integer iterations" 64 "integer photons" 300000
//
// Stochastic progressive photon mapping [HJ09] of a single frame: the honest baseline. It knows nothing of sharing: the
// driver gives it a scene of one frame at a time, and every pixel has one radius and one hit point. Parameters: see
// progressive_settings.cpp.
#include "integrators/sppm.h"

#include <cassert>

#include "core/parallel.h"
#include "integrators/pixel_statistics.h"
#include "integrators/progressive_settings.h"
#include "integrators/seen_light.h"

namespace dspm {
namespace {

enum Step { kHitPoints, kPhotons, kPhotonMap, kStatistics };

class Sppm final : public Integrator {
 public:
  Sppm(const ProgressiveSettings& settings, const Scene& scene, const RenderSettings& render)
      : settings_(settings),
        scene_(scene),
        render_(render),
        pixels_(static_cast<std::size_t>(render.crop.count())),
        seen_(render.crop.count(), 1) {
    statistics_.steps = {{"hit points"}, {"photons"}, {"photon map"}, {"statistics"}};
    statistics_.energy.resize(1);
    statistics_.bytes = bytes();
    assert(scene.frame_count() <= 1);  // or 0, where only parameters are checked
  }

  int iterations() const override { return settings_.iterations; }
  int photons() const override { return settings_.photons; }

  void iterate(int iteration) override {
    const auto number = static_cast<std::uint64_t>(iteration);
    {
      const StepTimer timer(statistics_.steps[kHitPoints]);
      tiles_ = trace_hit_points(scene_, render_, settings_.hit_point, number, std::move(tiles_));
    }
    {
      const StepTimer timer(statistics_.steps[kPhotons]);
      traces_ = trace_photons(scene_, settings_.photon, number, settings_.photons, std::move(traces_));
    }
    {
      const StepTimer timer(statistics_.steps[kPhotonMap]);
      const auto radius2_of = [&](const HitPoint& hit) { return radius2(hit); };
      map_.build(traces_, mean_search_radius(tiles_, radius2_of, scene_.radius));
    }
    {
      const StepTimer timer(statistics_.steps[kStatistics]);
      update_statistics();
    }
    emitted_ += settings_.photons;
    ++statistics_.iterations;
    count();
  }

  Image estimate(Frame) const override {
    Image image(render_.crop.width(), render_.crop.height());
    for (std::size_t pixel = 0; pixel < pixels_.size(); ++pixel)
      image.pixels[pixel] = seen_.mean(static_cast<int>(pixel), 0, statistics_.iterations) +
                            pixels_[pixel].radiance(static_cast<double>(emitted_));
    return image;
  }

  const PixelStatistics* pixel_statistics(int pixel, Frame) const override {
    return &pixels_[static_cast<std::size_t>(pixel)];
  }

  Statistics statistics() const override { return statistics_; }

 private:
  float radius2(const HitPoint& hit) const {
    const float R2 = pixels_[static_cast<std::size_t>(hit.pixel)].R2;
    return R2 > 0 ? R2 : hit.radius * hit.radius;
  }

  void update_statistics() {
    counts_.assign(tiles_.size(), {});
    parallel_for(static_cast<std::int64_t>(tiles_.size()), 1, [&](std::int64_t t) {
      const auto tile = static_cast<std::size_t>(t);
      for (const SeenLight& light : tiles_[tile].seen) seen_.add(light);
      for (const HitPoint& hit : tiles_[tile].hit_points) {
        PixelStatistics& pixel = pixels_[static_cast<std::size_t>(hit.pixel)];
        pixel.R2 = radius2(hit);
        PassSums sums;
        gather(hit, map_, pixel.R2, counts_[tile],
               [&](FrameSet, const Rgb& flux, float) { ++sums.M, sums.phi += flux; });
        sums.phi *= hit.throughput;
        pixel.absorb(sums, settings_.alpha);
      }
    });
  }

  void count() {
    account(tiles_, statistics_);
    account(traces_, statistics_);
    account(counts_, statistics_);
    statistics_.bytes = std::max(statistics_.bytes, bytes());
  }

  std::size_t bytes() const {
    return pixels_.capacity() * sizeof(PixelStatistics) + seen_.bytes() + map_.bytes() + bytes_of(tiles_) +
           bytes_of(traces_);
  }

  ProgressiveSettings settings_;
  const Scene& scene_;
  RenderSettings render_;
  std::vector<PixelStatistics> pixels_;
  SeenLightSums seen_;
  std::int64_t emitted_ = 0;
  std::vector<HitPointTile> tiles_;
  std::vector<PhotonTrace> traces_;
  PhotonMap map_;
  std::vector<GatherCounts> counts_;
  Statistics statistics_;
};

}  // namespace

std::unique_ptr<Integrator> make_sppm(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  const ProgressiveSettings settings = read_progressive_settings(params, render, false);
  return std::make_unique<Sppm>(settings, scene, render);
}

}  // namespace dspm
