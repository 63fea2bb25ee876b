// Columns with base and capital between nave and aisles, shafts that carry the nave's ribs from there up to the vault,
// and responds at the outer walls.
#include "dspm/base/math/vec.h"
#include "scenes/generator/hall.h"
#include "scenes/generator/modelling.h"

namespace dspm::hall {
namespace {

Transform at(float x, float y, float z) { return Transform(Matrix4::translate(x, y, z)); }

/// A square slab around the y axis.
MeshData slab(float half_width, float low, float high) {
  return box({-half_width, low, -half_width}, {half_width, high, half_width});
}

// Profiles (radius, height).
const std::vector<Vec2> kCore{{.69f, .27f}, {.71f, .32f}, {.69f, .38f}, {.62f, .41f},  {.58f, .48f}, {.63f, .56f},
                              {.5f, .63f},  {.46f, .7f},  {.44f, 3.3f}, {.48f, 3.34f}, {.48f, 3.4f}, {.44f, 3.43f},
                              {.45f, 3.6f}, {.5f, 3.78f}, {.6f, 3.93f}, {.7f, 4.04f}};
const std::vector<Vec2> kSlender{{.17f, .6f},   {.14f, .68f},  {.12f, .74f}, {.12f, 3.3f}, {.15f, 3.34f},
                                 {.15f, 3.39f}, {.12f, 3.43f}, {.13f, 3.6f}, {.24f, 4.04f}};
const std::vector<Vec2> kWallShaft{{.24f, kArcadeSpring}, {.25f, 4.3f}, {.15f, 4.46f}, {.15f, 8.05f}, {.19f, 8.1f},
                                   {.15f, 8.17f},         {.18f, 8.3f}, {.27f, 8.42f}, {.27f, 8.52f}, {0, 8.52f}};
const std::vector<Vec2> kRespond{{.34f, .24f}, {.35f, .3f},  {.22f, .48f},  {.2f, 3.5f},  {.25f, 3.53f},
                                 {.25f, 3.6f}, {.2f, 3.64f}, {.24f, 3.85f}, {.35f, 4.04f}};

/// A column from the floor to the arches: a core and four slender shafts, under a common abacus.
MeshData column() {
  MeshData mesh = slab(0.72f, -0.05f, 0.28f);
  append(mesh, lathe(kCore, 20));
  for (const auto& [x, z] : {Vec2{.46f, 0}, Vec2{-.46f, 0}, Vec2{0, .46f}, Vec2{0, -.46f}})
    append(mesh, lathe(kSlender, 8), at(x, 0, z));
  append(mesh, slab(0.74f, 4.03f, kArcadeSpring + 0.03f));
  return mesh;
}

/// It carries the aisles' ribs at the outer walls.
MeshData respond() {
  MeshData mesh = slab(0.36f, -0.05f, 0.25f);
  append(mesh, lathe(kRespond, 12));
  append(mesh, slab(0.37f, 4.03f, kArcadeSpring + 0.03f));
  return mesh;
}

}  // namespace

void add_piers(Parts& parts) {
  const MeshData whole = column(), shaft = lathe(kWallShaft, 10), half = respond();
  for (int i = 0; i <= kBays; ++i)
    for (const float side : {-1.f, 1.f}) {
      append(parts.trim, whole, at(pier_x(i), 0, side * (kNave + 0.5f * kPierWall)));
      append(parts.trim, shaft, at(pier_x(i), 0, side * (kNave - 0.02f)));
      append(parts.trim, half, at(pier_x(i), 0, side * kAisle));
    }
}

}  // namespace dspm::hall
