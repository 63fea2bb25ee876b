// Integrator "sppm" "integer iterations" 64 "integer photons" 300000
//
// Stochastic progressive photon mapping of a single frame, as [HJ09] or with [KZ11]'s radii: the honest baseline. It
// shares nothing between frames: the session gives it a scene of one frame at a time, and every pixel has one radius
// and one hit point. Parameters: see progressive_settings.cpp.
#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum_lanes.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/methods/progressive.h"
#include "dspm/integrators/possible_state.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

PassSums gather_at_one(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, float radius2,
                       GatherCounts& counts) {
  PassSums sums;
  SpectrumLanes phi;
  gather_photons(hit, tile.scattering_of(hit), map, radius2, counts,
                 [&](const Strand*, FrameSet, SpectrumLanes flux, float) { ++sums.M, phi += flux; });
  sums.phi = tile.palette->seen(phi.spectrum() * hit.throughput);
  return sums;
}

class SppmHj09 final : public PixelEstimator {
 public:
  explicit SppmHj09(const EstimatorSettings& of)
      : PixelEstimator(of), pixels_(of.pixel_frames()), passes_(of.batched ? of.pixel_frames() : 0) {
    assert(of.frames == 1);
  }
  static std::size_t bytes(const EstimatorSettings& of) {
    return of.pixel_frames() * (sizeof(PixelStatistics) + (of.batched ? sizeof(PassSums) : 0));
  }

  float search_radius2(const HitPoint& hit) const override {
    const float R2 = pixels_[static_cast<std::size_t>(hit.pixel)].R2;
    return R2 > 0 ? R2 : hit.radius * hit.radius;
  }

  void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, GatherCounts& counts) override {
    const auto at = static_cast<std::size_t>(hit.pixel);
    pixels_[at].begin(hit.radius * hit.radius);
    const PassSums sums = gather_at_one(hit, tile, map, pixels_[at].R2, counts);
    if (of_.batched)
      passes_[at] += sums;
    else
      pixels_[at].absorb(sums, of_.alpha);
  }

  void add(const SeenLight& light) override {
    pixels_[static_cast<std::size_t>(light.pixel)].see(light.radiance, static_cast<float>(of_.photons));
  }

  void end_iteration() override {
    parallel_for(static_cast<std::int64_t>(passes_.size()), 1 << 14, [&](std::int64_t i) {
      const auto at = static_cast<std::size_t>(i);
      pixels_[at].absorb(std::exchange(passes_[at], {}), of_.alpha);
    });
    ++iterations_;
  }

  bool adds_up() const override { return false; }

  void persist(StateStream& state) override {
    std::fill(passes_.begin(), passes_.end(), PassSums());
    state.value(iterations_);
    expect_iterations(iterations_);
    state.value(pixels_);
    expect_possible_statistics();
  }

  Rgb radiance(int pixel, Frame) const override {
    return statistics(pixel, 0)->radiance(static_cast<double>(iterations_ * of_.photons));
  }
  std::optional<PixelStatistics> statistics(int pixel, Frame) const override {
    return pixels_[static_cast<std::size_t>(pixel)];
  }

 private:
  int iterations_ = 0;
  std::vector<PixelStatistics> pixels_;
  std::vector<PassSums> passes_;  // of the iteration so far, if its photons come in batches
};

class SppmKz11 final : public PixelEstimator {
 public:
  explicit SppmKz11(const EstimatorSettings& of) : PixelEstimator(of), sums_(of.pixel_frames()) {
    assert(of.frames == 1);
  }
  static std::size_t bytes(const EstimatorSettings& of) { return of.pixel_frames() * sizeof(Rgb); }

  float search_radius2(const HitPoint& hit) const override { return of_.radius->squared(hit.radius); }

  void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, GatherCounts& counts) override {
    const float radius2 = search_radius2(hit);
    add(hit, gather_at_one(hit, tile, map, radius2, counts).phi, radius2);
  }

  bool takes_flux() const override { return true; }
  void take(const HitPoint& hit, const HitPointTile& tile, const FluxOfPoints::Of& flux) override {
    add(hit, tile.palette->seen(flux.shared() * hit.throughput), search_radius2(hit));
  }

  // Every iteration emits the same number of photons, so seen light is weighted by it and needs no separate sums.
  void add(const SeenLight& light) override {
    sums_[static_cast<std::size_t>(light.pixel)] += light.radiance * static_cast<float>(of_.photons);
  }

  void end_iteration() override { ++iterations_; }

  void persist(StateStream& state) override {
    state.sum(iterations_);
    expect_iterations(iterations_);
    state.sum(sums_);
  }

  Rgb radiance(int pixel, Frame) const override {
    const auto emitted = static_cast<double>(iterations_ * of_.photons);
    return emitted > 0 ? sums_[static_cast<std::size_t>(pixel)] * static_cast<float>(1 / emitted) : Rgb();
  }

 private:
  void add(const HitPoint& hit, const Rgb& phi, float radius2) {
    sums_[static_cast<std::size_t>(hit.pixel)] += phi / kernel_size(radius2);
  }

  int iterations_ = 0;     // done
  std::vector<Rgb> sums_;  // radiance times photons
};

}  // namespace

std::unique_ptr<Integrator> make_sppm(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  ProgressiveSettings settings = read_progressive_settings(params, render);
  expect_photons_in_media(params, settings, scene);
  choose_device(params, settings, scene, render);
  settings.may_choose = false;
  return make_progressive(settings, scene, render,
                          settings.kz11 ? estimator_kind<SppmKz11>() : estimator_kind<SppmHj09>());
}

}  // namespace dspm
