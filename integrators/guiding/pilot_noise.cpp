#include "dspm/integrators/guiding/pilot_noise.h"

#include <algorithm>
#include <numeric>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

// Random numbers of their own, so that what is bright by chance does not count less.
constexpr std::uint64_t kNoiseIteration = 3 * kPilotIteration, kBrightnessIteration = kNoiseIteration + 2;
constexpr std::int64_t kNoisePathsPerTrace = 1 << 5;
// What one sample per pixel adds to the variance of a pixel at most. An outlier is one, however bright.
constexpr double kMostOfAnOutlier = 64;

}  // namespace

NoisePilot::NoisePilot(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
                       const HitPointSettings& hit_point, std::int64_t paths)
    : scene_(sample),
      pixels_(with_independent_numbers(render), few_pixels(render)),
      photon_(photon),
      hit_point_(hit_point),
      paths_(paths),
      full_(static_cast<double>(render.width) * render.height) {
  hit_point_.sample_direct = hit_point_.share_paths = photon_.share_paths = true;
  hit_point_.frames = photon_.frames = few_frames(sample);
  photon_.stream = Stream::pilot, photon_.direct = nullptr, photon_.keep_ends = photon_.keep_seen = true;
  photon_.paths_per_trace = kNoisePathsPerTrace;
}

PilotSight NoisePilot::see(const HitPointSettings& hit_point, const DirectBalance* direct) const {
  return see(hit_point, direct, kNoiseIteration);
}

PilotSight NoisePilot::see(HitPointSettings hit_point, const DirectBalance* direct, std::uint64_t iteration) const {
  hit_point.direct = direct;
  PilotSight sight;
  double radii = 0;
  for (std::vector<double>& light : sight.light) {
    std::vector<HitPointTile> tiles = pixels_.trace(scene_, hit_point, iteration++);
    light.resize(pilot_pixels() * frames());
    for (const HitPointTile& tile : tiles) {
      for (const SeenLight& each : tile.seen)
        each.frames.for_each(
            [&](Frame f) { light[index(each.pixel, f)] += static_cast<double>(luminance(each.radiance)); });
      sight.rays += static_cast<double>(tile.paths.segments.done + tile.paths.shadow_rays);
      sight.hit_points += static_cast<double>(tile.hit_points.size());
      radii += tile.radii_in_pixels;
    }
    if (sight.tiles.empty()) sight.tiles = std::move(tiles);
  }
  if (sight.hit_points > 0) sight.radius_in_pixels = radii / sight.hit_points;
  const double paths = 2 * static_cast<double>(pilot_pixels());
  sight.rays /= paths, sight.hit_points /= paths;
  return sight;
}

std::vector<PhotonTrace> NoisePilot::photons(PhotonSettings photon, const EmissionGuides& guides,
                                             std::uint64_t iteration) const {
  photon.guides = &guides;
  return trace_photons(scene_, photon, iteration, 0, paths_, {});
}

NoisePilot::Gathering NoisePilot::gathering(const PilotSight& sight) const {
  return {{sight.tiles, &HitPointTile::hit_points, scale(), scene_.radius},
          {sight.tiles, &HitPointTile::glossy, scale(), scene_.radius}};
}

void NoisePilot::add_brought(const PilotSight& sight, const PhotonSettings& photon, const EmissionGuides& guides,
                             std::vector<double>& light) const {
  const auto add = [&](float radiance, FrameSet frames, const HitPoint& hit) {
    const double share = static_cast<double>(radiance) / static_cast<double>(paths_);
    frames.for_each([&](Frame f) { light[index(hit.pixel, f)] += share; });
  };
  const Gathering points = gathering(sight);
  for (const PhotonTrace& trace : photons(photon, guides, kBrightnessIteration)) {
    for (const Photon& each : trace.photons) points.matte.for_each_gathering(each, add);
    for (const Photon& each : trace.hidden) points.glossy.for_each_gathering(each, add);
    for (const CurvePhoton& each : trace.on_curves) points.glossy.for_each_gathering(each, add);
  }
}

/// Returns the mean of each pilot pixel and of all around it.
std::vector<double> NoisePilot::with_neighbours(const std::vector<double>& light) const {
  std::vector<double> result(light.size());
  const int columns = pixels_.columns(), rows = pixels_.rows();
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      for (std::size_t f = 0; f < frames(); ++f) {
        double sum = 0;
        int count = 0;
        for (int v = std::max(0, y - 1); v <= std::min(rows - 1, y + 1); ++v)
          for (int u = std::max(0, x - 1); u <= std::min(columns - 1, x + 1); ++u, ++count)
            sum += light[static_cast<std::size_t>(v * columns + u) * frames() + f];
        result[static_cast<std::size_t>(y * columns + x) * frames() + f] = sum / count;
      }
  return result;
}

// Two paths know little of a pixel, so those around it tell as well.
void NoisePilot::weigh(const HitPointSettings& hit_point, const DirectBalance* direct, const PhotonSettings* photon,
                       const EmissionGuides& guides) {
  const PilotSight sight = see(hit_point, direct, kBrightnessIteration);
  std::vector<double> light(sight.light[0].size());
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = (sight.light[0][i] + sight.light[1][i]) / 2;
  if (photon != nullptr) add_brought(sight, *photon, guides, light);
  const std::vector<double> around = with_neighbours(light);
  const double mean = std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(light.size());
  weights_.clear();
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double brightness = (light[i] + around[i]) / 2 + mean;
    weights_.push_back(brightness > 0 ? 1 / (brightness * brightness) : 0);
  }
}

double NoisePilot::noise_of(const PilotSight& sight) const {
  double sum = 0;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const double difference = sight.light[0][i] - sight.light[1][i];
    sum += std::min(kMostOfAnOutlier, weights_[i] * difference * difference / 2);
  }
  return sum / static_cast<double>(weights_.size());
}

// The variance of a later iteration is in inverse proportion to the number of its paths and to the area from which photons
// are gathered.
PilotGathers NoisePilot::gathers(const PilotSight& sight, const PhotonSettings& photon,
                                 const EmissionGuides& guides) const {
  const std::vector<PhotonTrace> traces = photons(photon, guides, kNoiseIteration);
  const Gathering points = gathering(sight);
  std::vector<PilotGathers> by_trace(traces.size());
  parallel_for(static_cast<std::int64_t>(traces.size()), 1, [&](std::int64_t t) {
    const PhotonTrace& trace = traces[static_cast<std::size_t>(t)];
    PilotGathers& sums = by_trace[static_cast<std::size_t>(t)];
    double along = 0;  // seen; of a light that camera paths never find, 0
    const auto add = [&](float radiance, FrameSet frames, const HitPoint& hit) {
      const auto r = static_cast<double>(radiance);
      double weight = 0;
      frames.for_each([&](Frame f) { weight += weights_[index(hit.pixel, f)]; });
      sums.variance += weight * r * r;
      // A camera path sees that much if it finds the light at all. [Veach 1997, 9.2]
      const float albedo = scene_.palette->luminance(hit.throughput) * (hit.scattering < 0 ? kPi : 1);
      sums.seen += weight * r * along * static_cast<double>(std::min(1.f, albedo));
      ++sums.found;
    };
    std::size_t i = 0, hidden = 0, curve = 0;
    for (const PhotonTrace::End& end : trace.ends) {
      const double before = sums.found;
      for (; i < end.photons; ++i) {
        along = static_cast<double>(trace.seen[i]);
        points.matte.for_each_gathering(trace.photons[i], add);
      }
      along = 0;
      for (; hidden < end.hidden; ++hidden) points.glossy.for_each_gathering(trace.hidden[hidden], add);
      for (; curve < end.on_curves; ++curve) points.glossy.for_each_gathering(trace.on_curves[curve], add);
      sums.found_share += sums.found > before;
    }
    sums.segments = static_cast<double>(trace.paths.segments.done);
  });
  PilotGathers sum;
  for (const PilotGathers& each : by_trace)
    sum.variance += each.variance, sum.seen += each.seen, sum.segments += each.segments, sum.found += each.found,
        sum.found_share += each.found_share;
  const double narrower = static_cast<double>(scale()) / kLaterRadius, paths = static_cast<double>(paths_),
               values = static_cast<double>(weights_.size());
  sum.variance *= narrower * narrower / (paths * values), sum.seen /= paths * values;
  sum.segments /= paths, sum.found_share /= paths;
  sum.found *= full_ / static_cast<double>(pilot_pixels()) / (narrower * narrower * paths);
  return sum;
}

}  // namespace dspm
