#include "dspm/integrators/methods/cut_light.h"

#include <algorithm>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/tiles.h"

namespace dspm {
namespace {

constexpr int kIterations = 8;

/// Sums up what the paths of one region find.
struct Tally {
  CutLight* by_frame;
  int max_depth;
  std::size_t half = 0;

  void add(const SeenLight& light, int scatterings) {
    const float seen = luminance(light.radiance);
    light.frames.for_each([&](Frame frame) {
      CutLight& sums = by_frame[static_cast<std::size_t>(frame)];
      (scatterings > max_depth ? sums.cut : sums.arrived)[half] += seen;
    });
  }
};

/// Samples one pixel in so many: enough paths for each region, but few in all.
std::uint64_t pixels_per_path(const PixelRect& crop) {
  const int wanted = std::clamp(crop.count() / 16, 1024, 16'384);
  return static_cast<std::uint64_t>(std::max(1, crop.count() / wanted));
}

int region_side(const PixelRect& crop) {
  constexpr int kMostAcross = 16, kLeast = 16;
  const int across = kMostAcross * kLeast, most = std::max(crop.width(), crop.height());
  return kLeast * std::max(1, (most + across - 1) / across);
}

}  // namespace

int region_count(const PixelRect& crop) { return tile_count(crop, region_side(crop)); }

PixelRect region(const PixelRect& crop, int index) {
  const int side = region_side(crop), columns = (crop.width() + side - 1) / side;
  const int x = crop.x0 + index % columns * side, y = crop.y0 + index / columns * side;
  return {x, y, std::min(x + side, crop.x1), std::min(y + side, crop.y1)};
}

std::vector<CutLight> no_cut_light(const Scene& scene, const RenderSettings& render) {
  return std::vector<CutLight>(static_cast<std::size_t>(region_count(render.crop) * scene.frame_count()));
}

std::size_t cut_light_bytes(const Scene& scene, const RenderSettings& render) {
  return 2 * sizeof(CutLight) * static_cast<std::size_t>(region_count(render.crop) * scene.frame_count());
}

void count_cut_light(const Scene& scene, const RenderSettings& render, const PathLimits& limits,
                     std::uint64_t iteration, Statistics& statistics) {
  if (statistics.iterations >= kIterations) return;
  const PathLimits further{4 * limits.max_depth + 64, limits.indirect};
  const std::uint64_t pixels = pixels_per_path(render.crop);
  parallel_for(region_count(render.crop), 1, [&](std::int64_t r) {
    Tally tally{&statistics.cut_light[static_cast<std::size_t>(r * scene.frame_count())], limits.max_depth};
    PathTracer tracer(scene, render, further, tally);
    const PixelRect pixels_here = region(render.crop, static_cast<int>(r));
    for (int y = pixels_here.y0; y < pixels_here.y1; ++y)
      for (int x = pixels_here.x0; x < pixels_here.x1; ++x) {
        const std::uint64_t chance = mix_bits(camera_path_index(render, x, y) * 0x9e3779b97f4a7c15u + iteration);
        if (chance % pixels != 0) continue;
        tally.half = chance / pixels % 2;
        tracer.trace(x, y, iteration);
      }
  });
}

}  // namespace dspm
