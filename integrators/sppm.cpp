// Integrator "sppm" "integer iterations" 64 "integer photons" 300000
//
// Stochastic progressive photon mapping of a single frame, as [HJ09] or with [KZ11]'s radii: the honest baseline. It
// knows nothing of sharing: the driver gives it a scene of one frame at a time, and every pixel has one radius and one
// hit point. Parameters: see progressive_settings.cpp.
#include "integrators/sppm.h"

#include <cassert>

#include "core/parallel.h"
#include "integrators/estimator.h"
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
        pixels_(settings.kz11 ? 0 : static_cast<std::size_t>(render.crop.count())),
        radiance_sums_(settings.kz11 ? static_cast<std::size_t>(render.crop.count()) : 0),
        seen_(settings.kz11 ? 0 : render.crop.count(), 1) {
    statistics_.steps = {{"hit points"}, {"photons"}, {"photon map"}, {"statistics"}};
    statistics_.energy.resize(1);
    statistics_.bytes = bytes();
    assert(scene.frame_count() <= 1);  // or 0, where only parameters are checked
  }

  int iterations() const override { return settings_.iterations; }
  std::string settings() const override { return in_words(settings_); }

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
    scale_ *= kz11_shrink(++statistics_.iterations, settings_.alpha);
    count();
  }

  Image estimate(Frame) const override {
    Image image(render_.crop.width(), render_.crop.height());
    for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel) image.pixels[pixel] = radiance(pixel);
    return image;
  }

  const PixelStatistics* pixel_statistics(int pixel, Frame) const override {
    return settings_.kz11 ? nullptr : &pixels_[static_cast<std::size_t>(pixel)];
  }

  Statistics statistics() const override { return statistics_; }

 private:
  Rgb radiance(std::size_t pixel) const {
    const auto emitted = static_cast<double>(emitted_);
    if (!settings_.kz11)
      return seen_.mean(static_cast<int>(pixel), 0, statistics_.iterations) + pixels_[pixel].radiance(emitted);
    return emitted > 0 ? radiance_sums_[pixel] * static_cast<float>(1 / emitted) : Rgb();
  }

  float radius2(const HitPoint& hit) const {
    if (settings_.kz11) {
      const float radius = hit.radius * static_cast<float>(scale_);
      return radius * radius;
    }
    const float R2 = pixels_[static_cast<std::size_t>(hit.pixel)].R2;
    return R2 > 0 ? R2 : hit.radius * hit.radius;
  }

  void update_statistics() {
    counts_.assign(tiles_.size(), {});
    parallel_for(static_cast<std::int64_t>(tiles_.size()), 1, [&](std::int64_t t) {
      const auto tile = static_cast<std::size_t>(t);
      for (const SeenLight& light : tiles_[tile].seen) see(light);
      for (const HitPoint& hit : tiles_[tile].hit_points) {
        const float R2 = radius2(hit);
        PassSums sums;
        RgbLanes phi;
        gather(hit, tiles_[tile].scattering_of(hit), map_, R2, counts_[tile],
               [&](FrameSet, RgbLanes flux, float) { ++sums.M, phi += flux; });
        sums.phi = phi.rgb() * hit.throughput;
        absorb(static_cast<std::size_t>(hit.pixel), sums, R2);
      }
    });
  }

  // kz11: every iteration emits as many photons, so what was seen is weighted by them and needs no sums of its own.
  void see(const SeenLight& light) {
    if (settings_.kz11)
      radiance_sums_[static_cast<std::size_t>(light.pixel)] += light.radiance * static_cast<float>(settings_.photons);
    else
      seen_.add(light);
  }

  void absorb(std::size_t pixel, const PassSums& sums, float R2) {
    if (settings_.kz11) {
      radiance_sums_[pixel] += sums.phi / (kPi * R2);
    } else {
      pixels_[pixel].R2 = R2;
      pixels_[pixel].absorb(sums, settings_.alpha);
    }
  }

  void count() {
    account(tiles_, statistics_);
    account(traces_, statistics_);
    account(counts_, statistics_);
    statistics_.bytes = std::max(statistics_.bytes, bytes());
  }

  std::size_t bytes() const {
    return pixels_.capacity() * sizeof(PixelStatistics) + radiance_sums_.capacity() * sizeof(Rgb) + seen_.bytes() +
           map_.bytes() + bytes_of(tiles_) + bytes_of(traces_);
  }

  ProgressiveSettings settings_;
  const Scene& scene_;
  RenderSettings render_;
  std::vector<PixelStatistics> pixels_;  // of hj09
  std::vector<Rgb> radiance_sums_;       // of kz11
  double scale_ = 1;                     // kz11's radii over the initial ones
  SeenLightSums seen_;                   // of hj09
  std::int64_t emitted_ = 0;
  std::vector<HitPointTile> tiles_;
  std::vector<PhotonTrace> traces_;
  PhotonMap map_;
  std::vector<GatherCounts> counts_;
  Statistics statistics_;
};

}  // namespace

std::unique_ptr<Integrator> make_sppm(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  const ProgressiveSettings settings = read_progressive_settings(params, render);
  return std::make_unique<Sppm>(settings, scene, render);
}

}  // namespace dspm
