// Progressive statistics for every pixel and frame [HJ09], gathered once for all frames that share a hit point
// [WG12 4.3].
#include <algorithm>
#include <array>
#include <vector>

#include "integrators/dsppm/dsppm.h"
#include "integrators/pixel_statistics.h"

namespace dspm {
namespace {

class Hj09 final : public PixelEstimator {
 public:
  explicit Hj09(const EstimatorSettings& of)
      : of_(of), statistics_(of.pixel_frames()), passes_(of.batched ? of.pixel_frames() : 0) {}
  static std::size_t bytes(const EstimatorSettings& of) {
    return of.pixel_frames() * (sizeof(PixelStatistics) + (of.batched ? sizeof(PassSums) : 0));
  }

  float search_radius2(const HitPoint& hit) const override {
    float largest2 = 0;
    hit.frames.for_each([&](Frame f) {
      const float R2 = statistics_[index(hit.pixel, f)].R2;
      largest2 = std::max(largest2, R2 == 0 ? hit.radius * hit.radius : R2);
    });
    return largest2;
  }

  void gather_at(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map,
                 GatherCounts& counts) override {
    PixelStatistics* pixel = &statistics_[index(hit.pixel, 0)];
    // The largest radius finds the photons of every frame; those within the smallest need no test by frame.
    float largest2 = 0, smallest2 = kInfinity;
    hit.frames.for_each([&](Frame f) {
      pixel[f].begin(hit.radius * hit.radius);
      largest2 = std::max(largest2, pixel[f].R2), smallest2 = std::min(smallest2, pixel[f].R2);
    });

    PassSums shared;
    std::array<PassSums, kMaxFrames> sums;
    gather(hit, scattering, map, largest2, counts, [&](FrameSet frames, RgbLanes lanes, float distance2) {
      const Rgb flux = lanes.rgb();
      if (frames == hit.frames && distance2 <= smallest2) {
        ++shared.M, shared.phi += flux;
        return;
      }
      frames.for_each([&](Frame f) {
        PassSums& sum = sums[static_cast<std::size_t>(f)];
        if (distance2 <= pixel[f].R2) ++sum.M, sum.phi += flux;
      });
    });

    hit.frames.for_each([&](Frame f) {
      PassSums& sum = sums[static_cast<std::size_t>(f)];
      sum.M += shared.M, sum.phi = (sum.phi + shared.phi) * hit.throughput;
      if (of_.batched)
        passes_[index(hit.pixel, f)] += sum;
      else
        pixel[f].absorb(sum, of_.alpha);
    });
  }

  void see(const SeenLight& light) override {
    light.frames.for_each(
        [&](Frame f) { statistics_[index(light.pixel, f)].see(light.radiance, static_cast<float>(of_.photons)); });
  }

  void end_iteration() override {
    absorb(passes_, statistics_, of_.alpha);
    ++iterations_;
  }

  Rgb radiance(int pixel, Frame frame) const override {
    const auto emitted = static_cast<double>(iterations_ * of_.photons);
    return statistics_[index(pixel, frame)].radiance(emitted);
  }

  const PixelStatistics* statistics(int pixel, Frame frame) const override { return &statistics_[index(pixel, frame)]; }

 private:
  std::size_t index(int pixel, Frame frame) const {
    return static_cast<std::size_t>(pixel) * static_cast<std::size_t>(of_.frames) + static_cast<std::size_t>(frame);
  }

  EstimatorSettings of_;
  int iterations_ = 0;
  std::vector<PixelStatistics> statistics_;  // the frames of a pixel lie together
  std::vector<PassSums> passes_;             // of the iteration so far, likewise, where its photons come in batches
};

}  // namespace

EstimatorKind shared_hj09() { return estimator_kind<Hj09>(); }

}  // namespace dspm
