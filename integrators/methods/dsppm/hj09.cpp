// Progressive statistics for every pixel and frame [HJ09], gathered once for all frames that share a hit point
// [WG12 4.3]. Frames are SIMD lanes.
#include <algorithm>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/methods/dsppm/dsppm.h"
#include "dspm/integrators/methods/dsppm/four_frames.h"
#include "dspm/integrators/pixel_frames.h"
#include "dspm/integrators/possible_state.h"

namespace dspm {
namespace {

constexpr int kGroups = kMaxFrames / 4;

/// The largest and smallest values of the selected lanes over several groups.
struct Extremes {
  __m128 most = _mm_setzero_ps(), least = _mm_set1_ps(kInfinity);

  void add(__m128 lanes, __m128 values) {
    most = _mm_max_ps(most, _mm_and_ps(lanes, values));
    least = _mm_min_ps(least, _mm_blendv_ps(_mm_set1_ps(kInfinity), values, lanes));
  }
  float largest() const {
    const __m128 two = _mm_max_ps(most, _mm_movehl_ps(most, most));
    return _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps(two, two, 1)));
  }
  float smallest() const {
    const __m128 two = _mm_min_ps(least, _mm_movehl_ps(least, least));
    return _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 1)));
  }
};

class Hj09 final : public PixelEstimator {
 public:
  explicit Hj09(const EstimatorSettings& of)
      : PixelEstimator(of), statistics_(of.pixels, groups(of)), passes_(of.batched ? of.pixels : 0, groups(of)) {}
  static std::size_t bytes(const EstimatorSettings& of) {
    return PixelFrames<FourFrames>::bytes(of.pixels, groups(of)) +
           (of.batched ? PixelFrames<FourSums>::bytes(of.pixels, groups(of)) : 0);
  }

  float search_radius2(const HitPoint& hit) const override {
    const float initial2 = hit.radius * hit.radius;
    Extremes radii;
    for_each_group(hit.frames, [&](int group, __m128 lanes) {
      const __m128 R2 = statistics_.at(hit.pixel, group).R2();
      radii.add(lanes, _mm_blendv_ps(R2, _mm_set1_ps(initial2), _mm_cmpeq_ps(R2, _mm_setzero_ps())));
    });
    return radii.largest();
  }

  void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, GatherCounts& counts) override {
    FourFrames* pixel = &statistics_.at(hit.pixel, 0);
    // The largest radius finds the photons of every frame; those within the smallest need no per-frame test.
    Extremes radii;
    FourSums sums[kGroups];
    for_each_group(hit.frames, [&](int group, __m128 lanes) {
      pixel[group].begin(lanes, hit.radius * hit.radius);
      radii.add(lanes, pixel[group].R2());
      sums[group] = FourSums();
    });

    FoundFlux shared;
    SpectrumLanes shared_flux;
    FewListSums<FoundFlux> lists;
    const float smallest2 = radii.smallest();
    const auto add_strands = [&](const Strand* strands, FrameSet frames, const Spectrum& flux, float photons,
                                 float distance2) {
      for_each_strand(strands, frames, [&](FrameSet alike, const Spectrum& weight) {
        for_each_group(alike, [&](int group, __m128 there) {
          const __m128 within = _mm_cmple_ps(_mm_set1_ps(distance2), pixel[group].R2());
          sums[group].add(_mm_and_ps(there, within), flux * weight, photons);
        });
      });
    };
    gather_photons(hit, tile.scattering_of(hit), map, radii.largest(), counts,
                   [&](const Strand* strands, FrameSet frames, SpectrumLanes flux, float distance2) {
                     const bool for_all = frames == hit.frames && distance2 <= smallest2;
                     if (for_all && strands == nullptr)
                       ++shared.M, shared_flux += flux;
                     else if (FoundFlux* sum = for_all && map.is_of_light(strands) ? lists.of(strands) : nullptr)
                       *sum += {1, flux.spectrum()};
                     else
                       add_strands(strands, frames, flux.spectrum(), 1, distance2);
                   });
    shared.flux = shared_flux.spectrum();
    lists.for_each([&](const Strand* list, const FoundFlux& sum) {
      add_strands(list, hit.frames, sum.flux, static_cast<float>(sum.M), 0);
    });

    for_each_strand(tile.strands.of(hit.strands), hit.frames, [&](FrameSet frames, const Spectrum& weight) {
      for_each_group(frames, [&](int group, __m128 lanes) {
        const FourSums total = sums[group].total(lanes, shared, hit.throughput * weight, *tile.palette);
        if (of_.batched)
          passes_.at(hit.pixel, group) += total;
        else
          pixel[group].absorb(total, of_.alpha);
      });
    });
  }

  void add(const SeenLight& light) override {
    light.frames.for_each([&](Frame f) {
      statistics_.at(light.pixel, f / 4).see(f % 4, light.radiance, static_cast<float>(of_.photons));
    });
  }

  void end_iteration() override {
    std::vector<FourSums>& passes = passes_.values();
    parallel_for(static_cast<std::int64_t>(passes.size()), 1 << 12, [&](std::int64_t i) {
      const auto at = static_cast<std::size_t>(i);
      statistics_.values()[at].absorb(std::exchange(passes[at], FourSums()), of_.alpha);
    });
    ++iterations_;
  }

  bool adds_up() const override { return false; }

  void persist(StateStream& state) override {
    std::fill(passes_.values().begin(), passes_.values().end(), FourSums());
    state.value(iterations_);
    expect_iterations(iterations_);
    state.value(statistics_.values());
    expect_possible_statistics();
  }

  Rgb radiance(int pixel, Frame frame) const override {
    const auto emitted = static_cast<double>(iterations_ * of_.photons);
    return statistics(pixel, frame)->radiance(emitted);
  }

  std::optional<PixelStatistics> statistics(int pixel, Frame frame) const override {
    return statistics_.at(pixel, frame / 4).of(frame % 4);
  }

 private:
  static int groups(const EstimatorSettings& of) { return (of.frames + 3) / 4; }

  int iterations_ = 0;
  PixelFrames<FourFrames> statistics_;  // by groups of four frames
  PixelFrames<FourSums> passes_;        // of the iteration so far; only if photons come in batches
};

}  // namespace

EstimatorKind shared_hj09() { return estimator_kind<Hj09>(); }

}  // namespace dspm
