// The product of lamp.dsc, a table lamp that stands on the origin: lamp_base.ply, of china; lamp_metal.ply, foot, stem
// and socket; harp.ply and spokes.ply, the wires that carry a shade; and the shades: drum.ply and drum_lining.ply,
// dome.ply and dome_lining.ply, globe.ply, a shell of reeded glass. The unit is 10 cm.
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/modelling.h"
#include "scenes/generator/subjects.h"
#include "scenes/generator/surface.h"

namespace dspm {
namespace {

constexpr int kSides = 180;

MeshData base() {
  return with_normals(lathe({{0, .16f},
                             {.5f, .16f},
                             {.66f, .22f},
                             {.8f, .45f},
                             {.92f, .8f},
                             {.95f, 1.12f},
                             {.88f, 1.45f},
                             {.73f, 1.76f},
                             {.53f, 2.05f},
                             {.36f, 2.3f},
                             {.25f, 2.52f},
                             {.21f, 2.75f},
                             {.22f, 2.9f},
                             {.2f, 2.94f},
                             {0, 2.94f}},
                            kSides),
                      60);
}

MeshData metal() {
  MeshData mesh = with_normals(
      lathe({{0, 0}, {.7f, 0}, {.73f, .02f}, {.73f, .08f}, {.69f, .12f}, {.6f, .19f}, {0, .19f}}, kSides), 40);
  append(mesh, with_normals(lathe({{0, 2.93f},
                                   {.23f, 2.93f},
                                   {.25f, 2.96f},
                                   {.23f, 3},
                                   {.09f, 3.03f},
                                   {.075f, 3.1f},
                                   {.075f, 3.4f},
                                   {.09f, 3.44f},
                                   {.2f, 3.48f},
                                   {.22f, 3.52f},
                                   {.22f, 3.86f},
                                   {.2f, 3.89f},
                                   {0, 3.89f}},
                                  kSides),
                            40));
  return mesh;
}

/// Two wires from the socket around the bulb up to a knob.
MeshData harp() {
  constexpr float kWire = .025f;
  MeshData mesh;
  for (const float side : {-1.f, 1.f})
    append(mesh, limb({{{side * .2f, 3.5f, 0}, kWire, kWire},
                       {{side * .5f, 3.9f, 0}, kWire, kWire},
                       {{side * .52f, 4.5f, 0}, kWire, kWire},
                       {{side * .3f, 4.95f, 0}, kWire, kWire},
                       {{0, 5.08f, 0}, kWire, kWire}},
                      {0, 0, 1}, 2));
  append(mesh, limb({{{0, 5.05f, 0}, .06f, .06f}, {{0, 5.3f, 0}, .05f, .05f}}, {1, 0, 0}, 2));
  return mesh;
}

/// From the knob to the drum.
MeshData spokes() {
  MeshData mesh;
  for (int i = 0; i < 3; ++i) {
    const float angle = 2 * kPi * (static_cast<float>(i) + 0.25f) / 3;
    append(mesh,
           limb({{{0, 5.1f, 0}, .022f, .022f}, {{.93f * std::cos(angle), 5.1f, .93f * std::sin(angle)}, .022f, .022f}},
                {0, 1, 0}, 2));
  }
  return mesh;
}

/// A profile turned to a sheet; the texture's u goes around, its v up.
MeshData turned(const std::function<Vec2(float)>& profile, int rows, float girth, float height) {
  return patch(
      kSides, rows,
      [=](float u, float v) {
        const Vec2 p = profile(v);
        return Vec3{p.x * std::cos(2 * kPi * u), p.y, -p.x * std::sin(2 * kPi * u)};
      },
      [=](float u, float v) {
        return Vec2{u * girth, v * height};
      });
}

void write_drum(const std::filesystem::path& directory) {
  const auto sheet = [](float inset) {
    return turned([=](float v) { return Vec2{1.42f - .5f * v - inset, 3.25f + 2 * v}; }, 8, 8, 2);
  };
  write_ply(directory / "drum.ply", sheet(0));
  write_ply(directory / "drum_lining.ply", sheet(.02f));
}

/// Up the outside from rim to crown; the lining is the same, a little smaller.
void write_dome(const std::filesystem::path& directory) {
  const auto sheet = [](float size) {
    return turned(
        [=](float v) {
          const float angle = v * kPi / 2;
          return Vec2{1.75f * size * std::cos(angle), 3.72f + 1.38f * size * std::sin(angle)};
        },
        40, 10, 2.5f);
  };
  write_ply(directory / "dome.ply", sheet(1));
  write_ply(directory / "dome_lining.ply", sheet(.985f));
}

/// A sphere with reeds of that depth, which run from pole to pole.
MeshData ball(float radius, float depth, int sides) {
  constexpr int kReeds = 36, kRings = 96;
  constexpr Vec3 kCentre{0, 4.57f, 0};
  std::vector<Vec2> half_circle;
  for (int i = 0; i <= kRings; ++i) {
    const float angle = kPi * static_cast<float>(i) / kRings;
    half_circle.push_back({i == 0 || i == kRings ? 0 : std::sin(angle), -std::cos(angle)});
  }
  MeshData mesh = lathe(half_circle, sides);
  for (Vec3& p : mesh.vertices) {
    const float flatter = std::pow(std::hypot(p.x, p.z), 1.5f);  // towards the poles
    p = kCentre + p * (radius + depth * flatter * std::cos(kReeds * std::atan2(p.z, p.x)));
  }
  return mesh;
}

/// Outside reeded like a column, inside smooth.
MeshData globe() {
  MeshData mesh = ball(1.2f, .022f, 504), hollow = ball(1.11f, 0, 180);
  for (Face& face : hollow.faces) std::swap(face[1], face[2]);
  append(mesh, hollow);
  return with_normals(mesh, 60);
}

}  // namespace

void make_lamp(const std::filesystem::path& directory) {
  write_ply(directory / "lamp_base.ply", base());
  write_ply(directory / "lamp_metal.ply", metal());
  write_ply(directory / "harp.ply", harp());
  write_ply(directory / "spokes.ply", spokes());
  write_drum(directory);
  write_dome(directory);
  write_ply(directory / "globe.ply", globe());
}

}  // namespace dspm
