// The water of water.dsc: water.01.ply to .25.ply, a frame every 1/25 s. Metres; the middle of the basin's floor is the
// origin, y is up. A drop hits the water, which opens and throws up a jet; a droplet leaves the jet and falls back in.
// The mesh is a closed body: its sides and its bottom lie a little inside the stone that holds the water, so that no
// light finds a gap.
#include <fmt/format.h>

#include <cmath>

#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/subjects.h"
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

/// Vertices of the upper side, row by row, and their faces.
MeshData upper_side(const WaterWaves& waves, float time) {
  const std::vector<float> at = coordinates();
  const std::vector<WaterWaves::Point> points = waves.surface(at, at, time);
  MeshData mesh;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float x = at[i % at.size()], z = at[i / at.size()];
    mesh.vertices.push_back({x - kSide / 2, kDepth + points[i].height, z - kSide / 2});
    mesh.normals.push_back(normalize(Vec3{-points[i].slope.x, 1, -points[i].slope.y}));
  }
  constexpr int kRow = kCells + 1;
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      const int a = j * kRow + i, b = a + 1, c = a + kRow, d = c + 1;
      mesh.faces.push_back({a, c, b});
      mesh.faces.push_back({b, c, d});
    }
  return mesh;
}

/// The rim of the upper side, counterclockwise seen from above, from a corner on; its first vertex is not repeated.
std::vector<int> rim() {
  constexpr int kRow = kCells + 1;
  std::vector<int> list;
  for (int i = 0; i < kCells; ++i) list.push_back(i * kRow);
  for (int i = 0; i < kCells; ++i) list.push_back(kCells * kRow + i);
  for (int i = kCells; i > 0; --i) list.push_back(i * kRow + kCells);
  for (int i = kCells; i > 0; --i) list.push_back(i);
  return list;
}

int add(MeshData& mesh, const Vec3& p, const Vec3& normal) {
  mesh.vertices.push_back(p);
  mesh.normals.push_back(normal);
  return static_cast<int>(mesh.vertices.size()) - 1;
}

/// Adds the sides and the bottom, which are hidden in the stone.
void close_below(MeshData& mesh) {
  const std::vector<int> edge = rim();
  const Vec3 down{0, -1, 0};
  const int middle = add(mesh, {0, -kInStone, 0}, down);
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const Vec3 p = mesh.vertices[static_cast<std::size_t>(edge[i])];
    const Vec3 q = mesh.vertices[static_cast<std::size_t>(edge[(i + 1) % edge.size()])];
    const Vec3 p_low{p.x, -kInStone, p.z}, q_low{q.x, -kInStone, q.z};
    const Vec3 side = normalize(Vec3{p.z - q.z, 0, q.x - p.x});
    const int a = add(mesh, p, side), b = add(mesh, q, side), c = add(mesh, p_low, side), d = add(mesh, q_low, side);
    mesh.faces.push_back({a, c, b});
    mesh.faces.push_back({b, c, d});
    mesh.faces.push_back({middle, add(mesh, q_low, down), add(mesh, p_low, down)});
  }
}

}  // namespace

void make_water(const std::filesystem::path& directory) {
  const Vec2 middle{0.47f * kSide, 0.52f * kSide};
  // The drop, the droplet that it throws up, and one that fell before: its rings cross the basin all the time.
  const WaterWaves waves(kSide, kDepth, 2e-5f,
                         {{5.2f * kSeconds, middle, 0.03f, 1.8f},
                          {20 * kSeconds, middle, 0.014f, 0.6f},
                          {-0.8f, {0.7f * kSide, 0.72f * kSide}, 0.024f, 0.9f}});
  for (int frame = 0; frame < kFrames; ++frame) {
    MeshData mesh = upper_side(waves, static_cast<float>(frame) * kSeconds);
    close_below(mesh);
    write_ply(directory / fmt::format("water.{:02}.ply", frame + 1), mesh);
  }
}

}  // namespace dspm
