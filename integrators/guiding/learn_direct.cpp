#include "dspm/integrators/guiding/learn_direct.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/guiding/pilot_pixels.h"
#include "dspm/integrators/photons/direct_balance.h"

namespace dspm {
namespace {

constexpr std::uint64_t kDirectIteration = 2 * kPilotIteration;  // random numbers of its own
constexpr float kLater = 0.55f;                                  // of the initial radius: that after 64 iterations
constexpr double kLeastByRays = 0.3;     // of the direct light by then, or photons bring it all if no guide was needed
constexpr double kLeastVariance = 0.02;  // of a ray; of two samples it is at most 2

class DirectPilot {
 public:
  DirectPilot(const Scene& sample, const RenderSettings& render, const HitPointSettings& settings)
      : scene_(sample), pixels_(with_independent_numbers(render), few_pixels(render)), settings_(settings) {
    settings_.share_paths = true, settings_.light_media = false, settings_.frames = few_frames(sample);
  }

  /// Returns what rays bring to the hit points, by pilot pixel and frame, if they share direct light as `balance` says;
  /// if it is null, rays bring none.
  std::vector<double> direct_light(const DirectBalance* balance, int again) {
    HitPointSettings settings = settings_;
    settings.sample_direct = balance != nullptr, settings.direct = balance;
    const auto tiles = pixels_.trace(scene_, settings, kDirectIteration + static_cast<std::uint64_t>(again));
    const auto frames = static_cast<std::size_t>(scene_.frame_count());
    std::vector<double> sums(static_cast<std::size_t>(pixels_.columns() * pixels_.rows()) * frames);
    for (const HitPointTile& tile : tiles)
      for (const SeenLight& light : tile.seen) {
        const auto place = static_cast<std::size_t>(pixels_.index(light.pixel)) * frames;
        light.frames.for_each([&](Frame f) {
          sums[place + static_cast<std::size_t>(f)] += static_cast<double>(luminance(light.radiance));
        });
      }
    radius_ = median_radius(tiles);
    tile_bytes_ = std::max(tile_bytes_, bytes_of(tiles)), sums_bytes_ += sums.size() * sizeof(double);
    return sums;
  }

  /// The typical radius of the last hit points.
  float radius() const { return radius_; }
  std::size_t bytes() const { return tile_bytes_ + sums_bytes_; }

 private:
  const Scene& scene_;
  PilotPixels pixels_;
  HitPointSettings settings_;
  float radius_ = 0;
  std::size_t tile_bytes_ = 0, sums_bytes_ = 0;
};

/// The mean of the relative variance over the places where anything is found, from two samples each.
double relative_variance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double both = a[i] + b[i];
    if (!(both > 0 && std::isfinite(both))) continue;
    sum += 2 * (a[i] - b[i]) * (a[i] - b[i]) / (both * both), ++count;
  }
  return count == 0 ? 2 : sum / count;
}

}  // namespace

void LearnedDirect::persist(StateStream& state) {
  std::uint8_t rays = by_rays;
  state.value(radius);
  state.value(photons_a_ray);
  state.value(rays);
  by_rays = rays != 0;
  const auto is_possible = [](float number) { return std::isfinite(number) && number >= 0; };
  if (!is_possible(radius) || !is_possible(photons_a_ray) || rays > 1)
    throw std::runtime_error("its record of how direct light is found is damaged");
}

LearnedDirect learn_direct(const Scene& sample, const RenderSettings& render, const HitPointSettings& settings,
                           std::int64_t photons, const EmissionGuides& guides, std::size_t& bytes) {
  DirectPilot pilot(sample, render, settings);
  LearnedDirect learned;
  const DirectBalance rays_alone(sample, {});
  const std::vector<double> seen = pilot.direct_light(nullptr, 0);
  if (!(pilot.radius() > 0 && std::isfinite(pilot.radius()))) return learned;
  learned.radius = pilot.radius();
  std::vector<double> alone = pilot.direct_light(&rays_alone, 0), again = pilot.direct_light(&rays_alone, 1);
  const std::vector<double> seen_again = pilot.direct_light(nullptr, 1);
  for (std::size_t i = 0; i < seen.size(); ++i) alone[i] -= seen[i], again[i] -= seen_again[i];
  learned.photons_a_ray = static_cast<float>(1 / std::max(kLeastVariance, relative_variance(alone, again)));
  const DirectBalance balance(sample, {photons, &guides, kLater * learned.radius, learned.photons_a_ray});
  const std::vector<double> shared = pilot.direct_light(&balance, 0);
  double by_rays = 0, all = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) by_rays += shared[i] - seen[i], all += alone[i];
  // Where a guide hardly sends photons, rays alone keep one from outweighing all others.
  learned.by_rays = !guides.are_off() || by_rays > kLeastByRays * all;
  bytes = sample.accel->memory() + pilot.bytes();
  return learned;
}

}  // namespace dspm
