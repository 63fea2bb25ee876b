#include "dspm/integrators/guiding/learn_indirect.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/guiding/pilot_pixels.h"
#include "dspm/integrators/guiding/visible_points.h"
#include "dspm/integrators/photons/direct_balance.h"

namespace dspm {
namespace {

constexpr std::uint64_t kIndirectIteration = 3 * kPilotIteration;        // random numbers of its own
constexpr std::int64_t kLeastPhotons = 1 << 11, kMostPhotons = 1 << 13;  // of each kind: a tenth of an iteration
constexpr std::int64_t kPhotonsPerTrace = 1 << 5;
constexpr double kNarrower = 0.55;   // of the initial radius: that after 64 iterations
constexpr double kMostOfWork = 0.8;  // to the same variance, or photons bring it all
constexpr double kWorkOfPhoton = 2;  // of a photon's segment, with the map and its gathers, over that of a camera ray

using Sums = std::vector<double>;  // luminances by pilot pixel and frame

/// The light that one camera path per pilot pixel sees without photons, and its price.
struct Seen {
  Sums light;
  std::vector<HitPointTile> tiles;
  double rays = 0;  // per pixel
};

class IndirectPilot {
 public:
  IndirectPilot(const Scene& scene, const RenderSettings& render, const PhotonSettings& photon,
                const HitPointSettings& hit_point, std::int64_t photons, const EmissionGuides& guides)
      : scene_(scene),
        pixels_(with_independent_numbers(render), few_pixels(render)),
        rays_(scene, {}),
        photon_(photon),
        hit_point_(hit_point),
        pilot_photons_(std::clamp(photons / 10, kLeastPhotons, kMostPhotons)),
        photons_(static_cast<double>(photons)),
        full_(static_cast<double>(render.width) * render.height) {
    hit_point_.sample_direct = hit_point_.share_paths = photon_.share_paths = true;
    hit_point_.direct = &rays_;
    hit_point_.frames = photon_.frames = few_frames(scene);
    photon_.stream = Stream::pilot, photon_.guides = &guides, photon_.direct = nullptr, photon_.keep_ends = false;
    photon_.paths_per_trace = kPhotonsPerTrace;
  }

  bool paths_pay() {
    const Seen ends[] = {see(false, 0), see(false, 1)}, goes[] = {see(true, 0), see(true, 1)};
    const Sums caustics[] = {gathered(goes[0], kCausticPhotons), gathered(goes[1], kCausticPhotons)};
    const Sums weights = weights_of(goes[0].light, goes[1].light);
    double direct = 0, indirect = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double a = ends[0].light[i], b = ends[1].light[i];
      const double further_a = goes[0].light[i] + caustics[0][i] - a, further_b = goes[1].light[i] + caustics[1][i] - b;
      direct += weights[i] * (a - b) * (a - b) / 2;
      indirect += weights[i] * (further_a - further_b) * (further_a - further_b) / 2;
    }
    const double by_photons = variance_by_photons(ends[0], weights);
    const double work_of_paths = full_ * goes[0].rays + photons_ * kWorkOfPhoton * segments(kCausticPhotons),
                 work_of_photons = full_ * ends[0].rays + photons_ * kWorkOfPhoton * segments(kDiffusePhotons);
    return (direct + indirect) * work_of_paths < kMostOfWork * (direct + by_photons) * work_of_photons;
  }

 private:
  Seen see(bool go_on, int again) const {
    HitPointSettings settings = hit_point_;
    settings.go_on = go_on;
    Seen seen;
    seen.tiles = pixels_.trace(scene_, settings, kIndirectIteration + static_cast<std::uint64_t>(again));
    seen.light.resize(pilot_pixels() * frames());
    for (const HitPointTile& tile : seen.tiles) {
      for (const SeenLight& light : tile.seen)
        add(seen.light, light.pixel, light.frames, static_cast<double>(luminance(light.radiance)));
      seen.rays += static_cast<double>(tile.paths.segments.done + tile.paths.shadow_rays);
    }
    seen.rays /= static_cast<double>(pilot_pixels());
    return seen;
  }

  /// Returns what photons of that kind bring to the hit points after the first.
  Sums gathered(const Seen& seen, unsigned kinds) {
    Sums sums(seen.light.size());
    const VisiblePoints points(seen.tiles, &HitPointTile::hit_points, scale(), scene_.radius);
    struct Found {
      float radiance;
      FrameSet frames;
      int pixel;
    };
    std::vector<std::vector<Found>> found(trace_of(kinds).size());
    for_each_photon(kinds, [&](std::size_t trace, const Photon& photon) {
      points.for_each_gathering(photon, [&](float radiance, FrameSet frames, const HitPoint& hit) {
        if (hit.indirect) found[trace].push_back({radiance, frames, hit.pixel});
      });
    });
    for (const std::vector<Found>& of_trace : found)
      for (const Found& each : of_trace)
        add(sums, each.pixel, each.frames, static_cast<double>(each.radiance) / static_cast<double>(pilot_photons_));
    return sums;
  }

  /// Returns the variance of a later iteration with photons that rough lobes have scattered. It is in inverse
  /// proportion to their number and to the area from which they are gathered.
  double variance_by_photons(const Seen& seen, const Sums& weights) {
    const VisiblePoints points(seen.tiles, &HitPointTile::hit_points, scale(), scene_.radius);
    Sums of_traces(trace_of(kDiffusePhotons).size());
    for_each_photon(kDiffusePhotons, [&](std::size_t trace, const Photon& photon) {
      points.for_each_gathering(photon, [&](float radiance, FrameSet frames, const HitPoint& hit) {
        const double square = static_cast<double>(radiance) * static_cast<double>(radiance);
        frames.for_each([&](Frame f) { of_traces[trace] += square * weights[index(hit.pixel, f)]; });
      });
    });
    const double squares = std::accumulate(of_traces.begin(), of_traces.end(), 0.0);
    const double narrower = static_cast<double>(scale()) / kNarrower;
    return squares / static_cast<double>(pilot_photons_) / photons_ * narrower * narrower;
  }

  /// Returns the segments of a photon path.
  double segments(unsigned kinds) {
    double sum = 0;
    for (const PhotonTrace& trace : trace_of(kinds)) sum += static_cast<double>(trace.paths.segments.done);
    return sum / static_cast<double>(pilot_photons_);
  }

  /// Calls fn(number of its trace, photon), in order within a trace; traces run on all threads.
  template <class Fn>
  void for_each_photon(unsigned kinds, Fn&& fn) {
    const std::vector<PhotonTrace>& traces = trace_of(kinds);
    parallel_for(static_cast<std::int64_t>(traces.size()), 1, [&](std::int64_t t) {
      for (const Photon& photon : traces[static_cast<std::size_t>(t)].photons) fn(static_cast<std::size_t>(t), photon);
    });
  }

  const std::vector<PhotonTrace>& trace_of(unsigned kinds) {
    if (kinds == traced_) return traces_;
    PhotonSettings photon = photon_;
    photon.kinds = kinds;
    traces_ = trace_photons(scene_, photon, kIndirectIteration, 0, pilot_photons_, std::move(traces_));
    traced_ = kinds;
    return traces_;
  }

  /// Weights errors relative to brightness, as the eye does.
  static Sums weights_of(const Sums& a, const Sums& b) {
    Sums weights;
    const double mean = (std::accumulate(a.begin(), a.end(), 0.0) + std::accumulate(b.begin(), b.end(), 0.0)) /
                        (2 * static_cast<double>(a.size()));
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double brightness = (a[i] + b[i]) / 2 + mean;
      weights.push_back(brightness > 0 ? 1 / (brightness * brightness) : 0);
    }
    return weights;
  }

  void add(Sums& sums, int pixel, FrameSet among, double light) const {
    among.for_each([&](Frame f) { sums[index(pixel, f)] += light; });
  }
  std::size_t index(int pixel, Frame f) const {
    return static_cast<std::size_t>(pixels_.index(pixel)) * frames() + static_cast<std::size_t>(f);
  }
  std::size_t frames() const { return static_cast<std::size_t>(scene_.frame_count()); }
  std::size_t pilot_pixels() const { return static_cast<std::size_t>(pixels_.columns() * pixels_.rows()); }
  /// Scales search radii: pilot pixels are further apart than pixels.
  float scale() const { return std::max(1.f, 0.5f * static_cast<float>(pixels_.stride)); }

  const Scene& scene_;
  PilotPixels pixels_;
  DirectBalance rays_;
  PhotonSettings photon_;
  HitPointSettings hit_point_;
  std::int64_t pilot_photons_;
  double photons_, full_;  // photon paths, pixels
  std::vector<PhotonTrace> traces_;
  unsigned traced_ = 0;
};

}  // namespace

bool paths_that_go_on_pay(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
                          const HitPointSettings& hit_point, std::int64_t photons, const EmissionGuides& guides) {
  return IndirectPilot(sample, render, photon, hit_point, photons, guides).paths_pay();
}

}  // namespace dspm
