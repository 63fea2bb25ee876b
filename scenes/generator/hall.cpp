// The cathedral of horse.dsc and figure9/: hall_*.ply, one file per material.
#include "scenes/generator/hall.h"

#include <algorithm>

#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/modelling.h"
#include "scenes/generator/subjects.h"

namespace dspm {
namespace hall {
namespace {

/// A flat tile with uv in metres; `diagonal` turns the pattern by 45 degrees.
MeshData tile(float x0, float x1, float z0, float z1, bool diagonal) {
  MeshData mesh{{{x0, 0, z0}, {x1, 0, z0}, {x1, 0, z1}, {x0, 0, z1}}, {}, {}, {{0, 2, 1}, {0, 3, 2}}};
  for (const Vec3& p : mesh.vertices)
    mesh.uvs.push_back(diagonal ? Vec2{(p.x + p.z) * 0.70710678f, (p.z - p.x) * 0.70710678f} : Vec2{p.x, p.z});
  return mesh;
}

}  // namespace

void add_floor(Parts& parts) {
  constexpr float kOut = 0.5f;  // under the walls
  constexpr float kBand = 3.5f, kBandEnd = 5.5f;
  const float west = -kEnd - kOut, east = kEnd + kNave + kOut;
  append(parts.floor, tile(west, east, -kBand, kBand, true));
  for (const float side : {-1.f, 1.f}) {
    const auto strip = [&](float z0, float z1) {
      return tile(west, east, std::min(side * z0, side * z1), std::max(side * z0, side * z1), false);
    };
    append(parts.border, strip(kBand, kBandEnd));
    append(parts.floor, strip(kBandEnd, kAisle + kOut));
  }
}

}  // namespace hall

void make_hall(const std::filesystem::path& directory) {
  hall::Parts parts;
  hall::add_floor(parts);
  hall::add_piers(parts);
  hall::add_walls(parts);
  hall::add_apse(parts);
  hall::add_vaults(parts);
  constexpr float kCrease = 40;
  const auto write = [&](const char* name, const MeshData& mesh) { write_ply(directory / name, mesh); };
  write("hall_floor.ply", parts.floor);
  write("hall_border.ply", parts.border);
  write("hall_stone.ply", with_normals(parts.stone, kCrease));
  write("hall_trim.ply", with_normals(parts.trim, kCrease));
  write("hall_webs.ply", with_normals(parts.webs, kCrease));
  write("hall_sunny.ply", parts.sunny);
  write("hall_shady.ply", parts.shady);
  write("hall_rose.ply", parts.rose);
}

}  // namespace dspm
