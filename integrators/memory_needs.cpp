#include "integrators/memory_needs.h"

#include <algorithm>
#include <tuple>

#include "integrators/photon_map.h"

namespace dspm {
namespace {

constexpr int kBlocks = 32, kBlockSide = 4;  // blocks of pixels that are looked at, along each side of the image
constexpr std::int64_t kPaths = 4096;
constexpr double kSlack = 1.15;  // iterations differ, and so do batches
// A grid has up to 8 cells of 4 bytes a photon, which takes 68 bytes besides: about half of that again.
constexpr double kWithCells = 1.5;

/// Without the room that vectors keep for growing: memory that was never written to is not taken.
std::size_t bytes_filled(const std::vector<HitPointTile>& tiles) {
  std::size_t sum = 0;
  for (const HitPointTile& tile : tiles)
    sum += tile.hit_points.size() * sizeof(HitPoint) + tile.scatterings.size() * sizeof(Scattering) +
           tile.seen.size() * sizeof(SeenLight) + tile.strands.end() * sizeof(Strand);
  return sum;
}

/// The block in the middle of the i-th of kBlocks parts of [low, high).
std::pair<int, int> block(int i, int low, int high) {
  const int side = std::min(kBlockSide, high - low);
  const int begin = low + static_cast<int>(static_cast<std::int64_t>(high - low - side) * (2 * i + 1) / (2 * kBlocks));
  return {begin, begin + side};
}

}  // namespace

void expect_enough(std::size_t memory, const MemoryNeeds& needs) {
  if (memory > 0 && needs.total() > memory) throw NotEnoughMemory(needs);
}

std::size_t hit_point_bytes(const Scene& scene, const RenderSettings& render, const HitPointSettings& settings) {
  double bytes = 0, pixels = 0;
  std::vector<HitPointTile> tiles;
  for (int j = 0; j < kBlocks; ++j)
    for (int i = 0; i < kBlocks; ++i) {
      RenderSettings part = render;
      std::tie(part.crop.x0, part.crop.x1) = block(i, render.crop.x0, render.crop.x1);
      std::tie(part.crop.y0, part.crop.y1) = block(j, render.crop.y0, render.crop.y1);
      bytes += static_cast<double>(bytes_filled(trace_hit_points(scene, part, settings, 0, {})));
      pixels += part.crop.count();
    }
  return static_cast<std::size_t>(kSlack * bytes / pixels * render.crop.count());
}

double bytes_a_photon_path(const Scene& scene, const PhotonSettings& settings) {
  const std::vector<PhotonTrace> traces = trace_photons(scene, settings, 0, 0, kPaths, {});
  PhotonMap map;
  map.build(traces, scene.frame_count(), 2 * scene.radius);  // a single cell: for few photons there would be too many
  double photons = static_cast<double>(map.size() * sizeof(Photon));
  for (const PhotonTrace& trace : traces) photons += static_cast<double>(trace.strands.end() * sizeof(Strand));
  return kSlack * (kWithCells * static_cast<double>(map.bytes()) + photons) / kPaths;
}

}  // namespace dspm
