#include "dspm/integrators/learn_direct.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dspm/colour/rgb.h"
#include "dspm/math/frames.h"

namespace dspm {
namespace {

constexpr double kPilotPixels = 4096;
constexpr std::uint64_t kPilotIteration = std::uint64_t{1} << 41;  // no iteration of the camera has that number
constexpr float kLater = 0.55f;                                    // of the initial radius: that after 64 iterations
constexpr double kLeastByRays = 0.3;     // of the direct light by then, or photons bring it all
constexpr double kLeastVariance = 0.02;  // of a ray; of two samples it is at most 2

class Pilot {
 public:
  Pilot(const Scene& sample, const RenderSettings& render, const HitPointSettings& settings)
      : scene_(sample),
        render_(render),
        settings_(settings),
        stride_(std::max(1, static_cast<int>(std::sqrt(render.width / kPilotPixels * render.height)))) {
    render_.crop = {0, 0, render.width, render.height};
    settings_.share_paths = true;
  }

  float typical_radius() {
    std::vector<float> radii;
    for (const HitPointTile& tile : trace(nullptr, 0))
      for (const HitPoint& hit : tile.hit_points) radii.push_back(hit.radius);
    if (radii.empty()) return 0;
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    return *middle;
  }

  /// Of what rays that share direct light as `balance` says bring to the hit points, by pilot pixel and frame; null:
  /// none.
  std::vector<double> direct_light(const DirectBalance* balance, int again) {
    const auto frames = static_cast<std::size_t>(scene_.frame_count());
    const int columns = (render_.width - 1) / stride_ + 1, rows = (render_.height - 1) / stride_ + 1;
    std::vector<double> sums(static_cast<std::size_t>(columns * rows) * frames);
    for (const HitPointTile& tile : trace(balance, again))
      for (const SeenLight& light : tile.seen) {
        const int x = light.pixel % render_.width, y = light.pixel / render_.width;
        const auto place = static_cast<std::size_t>(y / stride_ * columns + x / stride_);
        light.frames.for_each([&](Frame f) {
          sums[place * frames + static_cast<std::size_t>(f)] += static_cast<double>(luminance(light.radiance));
        });
      }
    sums_bytes_ += sums.size() * sizeof(double);
    return sums;
  }

  std::size_t bytes() const { return tile_bytes_ + sums_bytes_; }

 private:
  std::vector<HitPointTile> trace(const DirectBalance* balance, int again) {
    HitPointSettings settings = settings_;
    settings.sample_direct = balance != nullptr, settings.direct = balance;
    std::vector<HitPointTile> tiles =
        trace_hit_points(scene_, render_, settings, kPilotIteration + static_cast<std::uint64_t>(again), {}, stride_);
    tile_bytes_ = std::max(tile_bytes_, bytes_of(tiles));
    return tiles;
  }

  const Scene& scene_;
  RenderSettings render_;
  HitPointSettings settings_;
  int stride_;
  std::size_t tile_bytes_ = 0, sums_bytes_ = 0;
};

/// The mean of the relative variance over the places where anything is found, from two samples each.
double relative_variance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double both = a[i] + b[i];
    if (!(both > 0)) continue;
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
                           std::int64_t photons, const EmissionGuide& guide, std::size_t& bytes) {
  Pilot pilot(sample, render, settings);
  LearnedDirect learned;
  learned.radius = pilot.typical_radius();
  if (photons == 0 || learned.radius == 0) return learned;
  const DirectBalance rays_alone(sample, {});
  const std::vector<double> seen = pilot.direct_light(nullptr, 0);
  std::vector<double> alone = pilot.direct_light(&rays_alone, 0), again = pilot.direct_light(&rays_alone, 1);
  const std::vector<double> seen_again = pilot.direct_light(nullptr, 1);
  for (std::size_t i = 0; i < seen.size(); ++i) alone[i] -= seen[i], again[i] -= seen_again[i];
  learned.photons_a_ray = static_cast<float>(1 / std::max(kLeastVariance, relative_variance(alone, again)));
  const DirectBalance balance(sample, {photons, &guide, kLater * learned.radius, learned.photons_a_ray});
  const std::vector<double> shared = pilot.direct_light(&balance, 0);
  double by_rays = 0, all = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) by_rays += shared[i] - seen[i], all += alone[i];
  learned.by_rays = by_rays > kLeastByRays * all;
  bytes = sample.accel->memory() + pilot.bytes();
  return learned;
}

}  // namespace dspm
