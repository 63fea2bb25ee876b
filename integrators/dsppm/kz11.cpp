// Probabilistic progressive photon mapping [KZ11]: the search radius shrinks with the iteration alone. The estimate is
// then linear in the photons, so what all frames share is summed once for all, and other photons are added to the sums
// of those frames that have them.
#include <array>
#include <cmath>
#include <vector>

#include "integrators/estimator.h"

namespace dspm {
namespace {

class Kz11 final : public PixelEstimator {
 public:
  explicit Kz11(const EstimatorSettings& settings)
      : frames_(settings.frames),
        photons_(settings.photons),
        alpha_(settings.alpha),
        shared_(static_cast<std::size_t>(settings.pixels)),
        own_(static_cast<std::size_t>(settings.pixels) * static_cast<std::size_t>(settings.frames)) {}

  float search_radius2(const HitPoint& hit) const override {
    const float radius = hit.radius * static_cast<float>(scale_);
    return radius * radius;
  }

  void gather_at(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map,
                 GatherCounts& counts) override {
    const float radius2 = search_radius2(hit);
    const Rgb per_area = hit.throughput / (kPi * radius2);
    RgbLanes shared;
    std::array<RgbLanes, kMaxFrames> own;
    FrameSet with_own;
    gather(hit, scattering, map, radius2, counts, [&](FrameSet frames, RgbLanes flux, float) {
      if (frames == hit.frames) {
        shared += flux;
        return;
      }
      with_own |= frames;
      frames.for_each([&](Frame f) { own[static_cast<std::size_t>(f)] += flux; });
    });
    add(hit.pixel, hit.frames, shared.rgb() * per_area);
    with_own.for_each([&](Frame f) { own_[index(hit.pixel, f)] += own[static_cast<std::size_t>(f)].rgb() * per_area; });
  }

  // Every iteration emits as many photons, so what was seen can be weighted by them and needs no sums of its own.
  void see(const SeenLight& light) override {
    add(light.pixel, light.frames, light.radiance * static_cast<float>(photons_));
  }

  void end_iteration() override { scale_ *= kz11_shrink(++iterations_, alpha_); }

  Rgb radiance(int pixel, Frame frame) const override {
    if (iterations_ == 0) return {};
    const auto emitted = static_cast<double>(iterations_ * photons_);
    return (shared_[static_cast<std::size_t>(pixel)] + own_[index(pixel, frame)]) * static_cast<float>(1 / emitted);
  }

  std::size_t bytes() const override { return (shared_.capacity() + own_.capacity()) * sizeof(Rgb); }

 private:
  void add(int pixel, FrameSet frames, const Rgb& radiance_times_photons) {
    if (frames == FrameSet::first(frames_)) {
      shared_[static_cast<std::size_t>(pixel)] += radiance_times_photons;
    } else {
      frames.for_each([&](Frame f) { own_[index(pixel, f)] += radiance_times_photons; });
    }
  }

  std::size_t index(int pixel, Frame frame) const {
    return static_cast<std::size_t>(pixel) * static_cast<std::size_t>(frames_) + static_cast<std::size_t>(frame);
  }

  int frames_;
  std::int64_t photons_;  // emitted an iteration: the same in all
  float alpha_;
  std::int64_t iterations_ = 0;
  double scale_ = 1;         // s_i
  std::vector<Rgb> shared_;  // by pixel: radiance times photons, what counts in all frames
  std::vector<Rgb> own_;     // by pixel and frame: the rest
};

}  // namespace

std::unique_ptr<PixelEstimator> make_kz11(const EstimatorSettings& settings) {
  return std::make_unique<Kz11>(settings);
}

}  // namespace dspm
