#include "dspm/integrators/photons/memory_needs.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/hidden_light.h"
#include "dspm/integrators/photons/photon_map.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr int kBlocks = 32, kBlockSide = 4;  // blocks of sampled pixels, along each side of the image
constexpr std::int64_t kPaths = 4096;
constexpr double kSlack = 1.15;  // iterations and batches differ
// A grid has up to 8 cells of 4 bytes per photon, which itself takes 72 bytes: about half of that again.
constexpr double kWithCells = 1.5;

/// Excludes the spare capacity of vectors: memory that was never written to is not resident.
std::size_t bytes_filled(const std::vector<HitPointTile>& tiles) {
  std::size_t sum = 0;
  for (const HitPointTile& tile : tiles)
    sum += (tile.hit_points.size() + tile.glossy.size()) * sizeof(HitPoint) +
           tile.scatterings.size() * sizeof(Scattering) + tile.seen.size() * sizeof(SeenLight) +
           tile.strips.size() * sizeof(HitStrip) + tile.beams.size() * sizeof(CameraBeam) +
           tile.steps.size() * sizeof(MediumStep) + tile.strands.end() * sizeof(Strand);
  return sum;
}

/// Returns a block at a random position in the i-th of kBlocks pieces of [low, high), since regular positions might
/// miss regular features of an image. `random` is in [0, 1).
std::pair<int, int> block(int i, int low, int high, float random) {
  const int side = std::min(kBlockSide, high - low);
  const double part = static_cast<double>(high - low - side + 1) / kBlocks;
  const int begin = low + std::min(static_cast<int>(part * (i + static_cast<double>(random))), high - low - side);
  return {begin, begin + side};
}

/// The sample mean plus three times its standard error.
class SafeMean {
 public:
  void add(double value) { ++count_, sum_ += value, squares_ += value * value; }
  double value() const {
    const double mean = sum_ / count_, variance = std::max(squares_ / count_ - mean * mean, 0.);
    return mean + 3 * std::sqrt(variance / count_);
  }

 private:
  double count_ = 0, sum_ = 0, squares_ = 0;
};

}  // namespace

void expect_enough(std::size_t memory, const MemoryNeeds& needs) {
  if (memory > 0 && needs.total() > memory) throw NotEnoughMemory(needs);
}

std::size_t hit_point_bytes(const Scene& scene, const RenderSettings& render, const HitPointSettings& settings) {
  SafeMean bytes_a_pixel;
  for (int i = 0; i < kBlocks * kBlocks; ++i) {
    const Vec2 place = PathRandom(render.seed, Stream::setup, static_cast<std::uint64_t>(i), 0).pair(0, 0);
    RenderSettings part = render;
    std::tie(part.crop.x0, part.crop.x1) = block(i % kBlocks, render.crop.x0, render.crop.x1, place.x);
    std::tie(part.crop.y0, part.crop.y1) = block(i / kBlocks, render.crop.y0, render.crop.y1, place.y);
    bytes_a_pixel.add(static_cast<double>(bytes_filled(trace_hit_points(scene, part, settings, 0, {}))) /
                      part.crop.count());
  }
  return static_cast<std::size_t>(kSlack * bytes_a_pixel.value() * render.crop.count());
}

double bytes_a_photon_path(const Scene& scene, const PhotonSettings& settings, const LightGroups& groups) {
  const std::vector<PhotonTrace> traces = trace_photons(scene, settings, 0, 0, kPaths, {});
  PhotonMap map(groups);  // of a single cell: a few photons would have too many cells
  HiddenPhotons hidden(groups);
  map.build(traces, scene.frame_count(), 2 * scene.radius);
  hidden.build(traces, scene.frame_count(), 2 * scene.radius);
  double photons = static_cast<double>((map.size() + hidden.on_surfaces.size()) * sizeof(Photon) +
                                       hidden.on_curves.size() * sizeof(CurvePhoton));
  // Those in media are sorted as well, under boxes of four bytes for each.
  constexpr std::size_t kSorted = 4 * sizeof(void*) + sizeof(float);
  for (const PhotonTrace& trace : traces)
    photons += static_cast<double>(trace.strands.end() * sizeof(Strand) +
                                   trace.in_media.size() * (sizeof(MediumPhoton) + kSorted));
  return kSlack * (kWithCells * static_cast<double>(map.bytes() + hidden.bytes()) + photons) / kPaths;
}

}  // namespace dspm
