// The water of water.dsc: water.01.ply to .25.ply, a frame every 1/25 s. Metres; the middle of the basin's floor is the
// origin, y is up. A drop hits the water, which opens and throws up a jet; a droplet leaves the jet and falls back in.
// The mesh is a closed body: its sides and its bottom lie a little inside the stone that holds the water, so that no
// light finds a gap.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/subjects.h"
#include "scenes/generator/water_body.h"
#include "scenes/generator/water_waves.h"

namespace dspm {
namespace {

constexpr int kFrames = 25, kCells = 100;
constexpr float kSeconds = 1.f / 25;  // a frame
constexpr float kSide = 0.6f, kDepth = 0.1f, kInStone = 0.004f;
constexpr float kFinerInside = 0.35f;  // cells in the middle are smaller by this fraction, those at the walls larger

std::vector<float> coordinates() {
  std::vector<float> list;
  for (int i = 0; i <= kCells; ++i) {
    const float s = static_cast<float>(i) / kCells;
    const float finer = s + kFinerInside * std::sin(2 * kPi * s) / (2 * kPi);
    list.push_back(-kInStone + (kSide + 2 * kInStone) * finer);
  }
  return list;
}

MeshData water(const WaterWaves& waves, float time) {
  const std::vector<float> at = coordinates();
  std::vector<Vec3> points, normals;
  for (const WaterWaves::Point& point : waves.surface(at, at, time)) {
    const float x = at[points.size() % at.size()], z = at[points.size() / at.size()];
    points.push_back({x - kSide / 2, kDepth + point.height, z - kSide / 2});
    normals.push_back(normalize(Vec3{-point.slope.x, 1, -point.slope.y}));
  }
  return water_body(std::move(points), std::move(normals), static_cast<int>(at.size()), -kInStone);
}

}  // namespace

void make_water(const std::filesystem::path& directory) {
  const Vec2 middle{0.47f * kSide, 0.52f * kSide};
  // The drop, the droplet that it throws up, and one that fell before: its rings cross the basin all the time.
  const WaterWaves waves(kSide, kDepth, 2e-5f,
                         {{5.2f * kSeconds, middle, 0.03f, 1.8f},
                          {20 * kSeconds, middle, 0.014f, 0.6f},
                          {-0.8f, {0.7f * kSide, 0.72f * kSide}, 0.024f, 0.9f}});
  for (int frame = 0; frame < kFrames; ++frame)
    write_ply(directory / fmt::format("water.{:02}.ply", frame + 1),
              water(waves, static_cast<float>(frame) * kSeconds));
}

}  // namespace dspm
