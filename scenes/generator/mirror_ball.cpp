// The mirror ball of disco.dsc: mirror_ball.ply, radius 1 around the origin, hung along y. Flat square tiles in rings
// of equal latitude, each with a little gap around it and, being glued by hand, not quite true. Rings hold a multiple
// of six tiles, and each sixth is like the others: a turn by 60 degrees gives the same ball.
#include <algorithm>
#include <cmath>

#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/subjects.h"

namespace dspm {
namespace {

constexpr int kRings = 34, kSixths = 6;
constexpr float kFill = 0.93f;   // of the pitch
constexpr float kTilt = 0.006f;  // radians, at most

Vec3 on_sphere(float latitude, float longitude) {
  return {std::cos(latitude) * std::cos(longitude), std::sin(latitude), std::cos(latitude) * std::sin(longitude)};
}

struct Tile {
  float latitude, longitude, half_height, half_angle;
  Vec2 tilt;
};

/// A flat tile: the corners' directions, met with a plane through the middle.
void add_tile(MeshData& mesh, const Tile& tile) {
  const Vec3 middle = on_sphere(tile.latitude, tile.longitude);
  const Basis around = Basis::around(middle);
  const Vec3 normal = normalize(middle + around.x * tile.tilt.x + around.y * tile.tilt.y);
  const int first = static_cast<int>(mesh.vertices.size());
  for (const Vec2 corner : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{1, 1}, Vec2{-1, 1}}) {
    const Vec3 w = on_sphere(tile.latitude + corner.y * tile.half_height, tile.longitude + corner.x * tile.half_angle);
    mesh.vertices.push_back(w * (dot(middle, normal) / dot(w, normal)));
  }
  mesh.faces.push_back({first, first + 2, first + 1});
  mesh.faces.push_back({first, first + 3, first + 2});
}

void add_ring(MeshData& mesh, int ring) {
  const float pitch = kPi / kRings, latitude = (static_cast<float>(ring) + 0.5f) * pitch - kPi / 2;
  const int in_sixth = static_cast<int>(std::lround(std::max(1.f, 2 * kRings * std::cos(latitude) / kSixths)));
  const float step = 2 * kPi / static_cast<float>(kSixths * in_sixth);
  for (int i = 0; i < kSixths * in_sixth; ++i) {
    const PathRandom random(0, Stream::setup, static_cast<std::uint64_t>(i % in_sixth), 0);
    const Vec2 u = random.pair(ring, 0);
    const Vec2 tilt{kTilt * (2 * u.x - 1), kTilt * (2 * u.y - 1)};
    add_tile(mesh, {latitude, static_cast<float>(i) * step, 0.5f * kFill * pitch, 0.5f * kFill * step, tilt});
  }
}

}  // namespace

void make_mirror_ball(const std::filesystem::path& directory) {
  MeshData mesh;
  for (int ring = 0; ring < kRings; ++ring) add_ring(mesh, ring);
  write_ply(directory / "mirror_ball.ply", mesh);
}

}  // namespace dspm
