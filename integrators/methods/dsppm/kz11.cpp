// Probabilistic progressive photon mapping [KZ11]: the search radius depends only on the iteration. The estimate is
// then linear in the photons, so photons shared by all frames are summed once, and the others are added to the sums of
// their frames.
#include <vector>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/methods/dsppm/dsppm.h"
#include "dspm/integrators/photons/gather.h"
#include "dspm/integrators/pixel_frames.h"
#include "dspm/integrators/possible_state.h"

namespace dspm {
namespace {

class Kz11 final : public PixelEstimator {
 public:
  explicit Kz11(const EstimatorSettings& of)
      : PixelEstimator(of), shared_(static_cast<std::size_t>(of.pixels)), own_(of.pixels, of.frames) {}
  static std::size_t bytes(const EstimatorSettings& of) {
    return static_cast<std::size_t>(of.pixels) * sizeof(Rgb) + PixelFrames<Rgb>::bytes(of.pixels, of.frames);
  }

  float search_radius2(const HitPoint& hit) const override { return of_.radius->squared(hit.radius); }

  void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, GatherCounts& counts) override {
    GatheredFlux flux(hit, map);
    gather_photons(hit, tile.scattering_of(hit), map, search_radius2(hit), counts,
                   [&](const Strand* strands, FrameSet frames, SpectrumLanes photon, float) {
                     flux.add(strands, frames, photon);
                   });
    flux.end();
    add(hit, tile, flux);
  }

  bool takes_flux() const override { return true; }
  void take(const HitPoint& hit, const HitPointTile& tile, const FluxOfPoints::Of& flux) override {
    add(hit, tile, flux);
  }

  // Every iteration emits the same number of photons, so seen light is weighted by it and needs no separate sums.
  void add(const SeenLight& light) override {
    add(light.pixel, light.frames, light.radiance * static_cast<float>(of_.photons));
  }
  void end_iteration() override { ++iterations_; }

  void persist(StateStream& state) override {
    state.sum(iterations_);
    expect_iterations(iterations_);
    state.sum(shared_);
    state.sum(own_.values());
  }

  Rgb radiance(int pixel, Frame frame) const override {
    if (iterations_ == 0) return {};
    const auto emitted = static_cast<double>(iterations_ * of_.photons);
    return (shared_[static_cast<std::size_t>(pixel)] + own_.at(pixel, frame)) * static_cast<float>(1 / emitted);
  }

 private:
  /// `flux` is a GatheredFlux or FluxOfPoints::Of.
  template <class Flux>
  void add(const HitPoint& hit, const HitPointTile& tile, const Flux& flux) {
    const Spectrum per_area = hit.throughput / kernel_size(search_radius2(hit));
    for_each_strand(tile.strands.of(hit.strands), hit.frames, [&](FrameSet frames, const Spectrum& weight) {
      const Spectrum times = per_area * weight;
      const auto seen = [&](const Spectrum& brought) { return tile.palette->seen(brought * times); };
      add(hit.pixel, frames, seen(flux.shared()));
      (frames & flux.with_own()).for_each([&](Frame f) { own_.at(hit.pixel, f) += seen(flux.own(f)); });
    });
  }

  void add(int pixel, FrameSet frames, const Rgb& radiance_times_photons) {
    if (frames == FrameSet::first(of_.frames)) {
      shared_[static_cast<std::size_t>(pixel)] += radiance_times_photons;
    } else {
      frames.for_each([&](Frame f) { own_.at(pixel, f) += radiance_times_photons; });
    }
  }

  int iterations_ = 0;       // done
  std::vector<Rgb> shared_;  // by pixel: radiance times photons, common to all frames
  PixelFrames<Rgb> own_;     // the rest
};

}  // namespace

EstimatorKind shared_kz11() { return estimator_kind<Kz11>(); }

}  // namespace dspm
