// Vaults over nave and aisles: two pointed barrels that cross in every bay, ribs where they meet and along their edges,
// a boss in the middle.
#include <algorithm>
#include <cmath>
#include <utility>

#include "dspm/base/math/vec.h"
#include "scenes/generator/hall.h"
#include "scenes/generator/modelling.h"

namespace dspm::hall {
namespace {

struct Bay {
  float x0, x1, z0, z1, spring, rise;
  int steps;  // of half an arch

  Vec3 middle() const { return {0.5f * (x0 + x1), spring + rise, 0.5f * (z0 + z1)}; }
  /// u and v run from -1 to 1 along x and z.
  Vec3 point(float u, float v, float height) const {
    const float x = u == -1 ? x0 : u == 1 ? x1 : 0.5f * ((1 - u) * x0 + (1 + u) * x1);
    return {x, spring + rise * height, 0.5f * ((1 - v) * z0 + (1 + v) * z1)};
  }
};

constexpr float kIntoWall = 1.02f;  // the web beyond the wall's face, in half widths

/// The places along a whole arch, from -1 to 1.
std::vector<float> whole_arch(int steps) {
  const std::vector<float> half = arch_places(kPointedness, steps);
  std::vector<float> places;
  for (const float t : half) places.push_back(-t);
  for (auto t = half.rbegin() + 1; t != half.rend(); ++t) places.push_back(*t);
  return places;
}

/// One of the four cells between the diagonals: a piece of the barrel across x or across z, on the side `sign`.
void add_cell(MeshData& webs, const Bay& bay, bool across_x, float sign, float reach) {
  MeshData cell;
  const std::vector<float> places = whole_arch(bay.steps);
  for (const float t : places) {
    const float height = arch_height(std::abs(t), kPointedness), near = sign * std::abs(t), far = sign * reach;
    cell.vertices.push_back(across_x ? bay.point(t, near, height) : bay.point(near, t, height));
    cell.vertices.push_back(across_x ? bay.point(t, far, height) : bay.point(far, t, height));
  }
  for (int i = 0; i + 1 < static_cast<int>(places.size()); ++i) {
    const int a = 2 * i, b = a + 1, c = a + 2, d = a + 3;
    const bool turned = across_x == (sign < 0);
    for (Face face : {Face{a, b, d}, Face{a, d, c}}) {
      if (turned) std::swap(face[1], face[2]);
      const auto at = [&](int k) { return cell.vertices[static_cast<std::size_t>(face[static_cast<std::size_t>(k)])]; };
      if (length(cross(at(1) - at(0), at(2) - at(0))) > 1e-6f) cell.faces.push_back(face);
    }
  }
  append(webs, cell);
}

void add_rib(MeshData& trim, const Bay& bay, Vec2 from, Vec2 to, float width, float height, int corners) {
  std::vector<Vec3> path;
  for (const float t : whole_arch(bay.steps)) {
    const Vec2 p = (from + to) * 0.5f + (to - from) * (0.5f * t);
    path.push_back(bay.point(p.x, p.y, arch_height(std::abs(t), kPointedness)));
  }
  const Vec3 along = path.back() - path.front();
  append(trim, sweep(ellipse(width, height, corners), path, normalize(Vec3{-along.z, 0, along.x})));
}

void add_boss(MeshData& trim, const Vec3& middle, float size) {
  append(trim,
         lathe({{0, -1.2f * size}, {.55f * size, -1.05f * size}, {.95f * size, -.5f * size}, {size, .2f * size}}, 12),
         Transform(Matrix4::translate(middle.x, middle.y, middle.z)));
}

/// `reach`: how far the cells along the walls go, in half widths.
void add_vault(Parts& parts, const Bay& bay, float size, bool last) {
  for (const float sign : {-1.f, 1.f}) {
    add_cell(parts.webs, bay, true, sign, kIntoWall);
    add_cell(parts.webs, bay, false, sign, 1);
    add_rib(parts.trim, bay, {-1, sign}, {1, sign}, 0.06f * size, 0.1f * size, 5);  // along the wall
  }
  add_rib(parts.trim, bay, {-1, -1}, {1, 1}, 0.1f * size, 0.16f * size, 7);
  add_rib(parts.trim, bay, {-1, 1}, {1, -1}, 0.1f * size, 0.16f * size, 7);
  add_rib(parts.trim, bay, {-1, -1}, {-1, 1}, 0.17f * size, 0.22f * size, 8);
  if (last) add_rib(parts.trim, bay, {1, -1}, {1, 1}, 0.17f * size, 0.22f * size, 8);
  add_boss(parts.trim, bay.middle(), 0.3f * size);
}

}  // namespace

void add_vaults(Parts& parts) {
  for (int i = 0; i < kBays; ++i) {
    const bool last = i + 1 == kBays;
    add_vault(parts, {pier_x(i), pier_x(i + 1), -kNave, kNave, kVaultSpring, kVaultRise, 9}, 1, last);
    for (const float side : {-1.f, 1.f}) {
      const float near = side * (kNave + kPierWall), far = side * kAisle;
      add_vault(parts,
                {pier_x(i), pier_x(i + 1), std::min(near, far), std::max(near, far), kArcadeSpring, kAisleRise, 6},
                0.7f, last);
    }
  }
}

}  // namespace dspm::hall
