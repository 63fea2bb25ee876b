// Probabilistic progressive photon mapping [KZ11]: the search radius depends only on the iteration. The estimate is
// then linear in the photons, so photons shared by all frames are summed once, and the others are added to the sums of
// their frames.
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/integrators/dsppm/dsppm.h"
#include "dspm/integrators/kernel_size.h"
#include "dspm/math/frames.h"

namespace dspm {
namespace {

class Kz11 final : public PixelEstimator {
 public:
  explicit Kz11(const EstimatorSettings& of)
      : of_(of), shared_(static_cast<std::size_t>(of.pixels)), own_(of.pixel_frames()) {}
  static std::size_t bytes(const EstimatorSettings& of) {
    return (static_cast<std::size_t>(of.pixels) + of.pixel_frames()) * sizeof(Rgb);
  }

  float search_radius2(const HitPoint& hit) const override { return radius_.squared(hit); }

  void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, GatherCounts& counts) override {
    const float radius2 = radius_.squared(hit);
    const Rgb per_area = hit.throughput / kernel_size(radius2);
    RgbLanes shared;
    FewListSums<RgbLanes> lists;
    __m128 own[kMaxFrames];  // valid only for the frames in with_own
    FrameSet with_own;
    const auto add_own = [&](FrameSet frames, RgbLanes flux) {
      (frames - with_own).for_each([&](Frame f) { own[f] = _mm_setzero_ps(); });
      with_own |= frames;
      frames.for_each([&](Frame f) {
        auto& sum = own[f];
        sum = _mm_add_ps(sum, flux.lanes);
      });
    };
    const auto add_strands = [&](const Strand* strands, FrameSet frames, RgbLanes flux) {
      for_each_strand(strands, frames, [&](FrameSet alike, const Rgb& weight) {
        add_own(alike, RgbLanes(_mm_mul_ps(flux.lanes, RgbLanes(weight).lanes)));
      });
    };
    gather(hit, tile.scattering_of(hit), map, radius2, counts,
           [&](const Strand* strands, FrameSet frames, RgbLanes flux, float) {
             if (strands == nullptr && frames == hit.frames)
               shared += flux;
             else if (strands == nullptr)
               add_own(frames, flux);
             else if (RgbLanes* sum = frames == hit.frames && map.is_of_light(strands) ? lists.of(strands) : nullptr)
               *sum += flux;
             else
               add_strands(strands, frames, flux);
           });
    lists.for_each([&](const Strand* list, RgbLanes flux) { add_strands(list, hit.frames, flux); });
    for_each_strand(tile.strands.of(hit.strands), hit.frames, [&](FrameSet frames, const Rgb& weight) {
      const Rgb times = per_area * weight;
      add(hit.pixel, frames, shared.rgb() * times);
      (frames & with_own).for_each([&](Frame f) { own_[index(hit.pixel, f)] += RgbLanes(own[f]).rgb() * times; });
    });
  }

  // Every iteration emits the same number of photons, so seen light is weighted by it and needs no separate sums.
  void see(const SeenLight& light) override {
    add(light.pixel, light.frames, light.radiance * static_cast<float>(of_.photons));
  }

  void begin_iteration(int iteration) override { radius_.go_to(iteration, of_.alpha); }
  void end_iteration() override { ++iterations_; }

  void persist(StateStream& state) override {
    state.sum(iterations_);
    state.sum(shared_);
    state.sum(own_);
  }

  Rgb radiance(int pixel, Frame frame) const override {
    if (iterations_ == 0) return {};
    const auto emitted = static_cast<double>(iterations_ * of_.photons);
    return (shared_[static_cast<std::size_t>(pixel)] + own_[index(pixel, frame)]) * static_cast<float>(1 / emitted);
  }

 private:
  void add(int pixel, FrameSet frames, const Rgb& radiance_times_photons) {
    if (frames == FrameSet::first(of_.frames)) {
      shared_[static_cast<std::size_t>(pixel)] += radiance_times_photons;
    } else {
      frames.for_each([&](Frame f) { own_[index(pixel, f)] += radiance_times_photons; });
    }
  }

  std::size_t index(int pixel, Frame frame) const {
    return static_cast<std::size_t>(pixel) * static_cast<std::size_t>(of_.frames) + static_cast<std::size_t>(frame);
  }

  EstimatorSettings of_;
  IterationRadius radius_;
  int iterations_ = 0;       // done
  std::vector<Rgb> shared_;  // by pixel: radiance times photons, common to all frames
  std::vector<Rgb> own_;     // by pixel and frame: the rest
};

}  // namespace

EstimatorKind shared_kz11() { return estimator_kind<Kz11>(); }

}  // namespace dspm
