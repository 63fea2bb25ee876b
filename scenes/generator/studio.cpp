// The things around the chair of chair.dsc: cove.ply, floor and wall in one sheet, the wall's foot rounded;
// side_table.ply, a tray on a stem; vase.ply, of glass. Table and vase stand on the origin. The unit is 10 cm.
#include <cmath>

#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/modelling.h"
#include "scenes/generator/subjects.h"
#include "scenes/generator/surface.h"

namespace dspm {
namespace {

constexpr int kSides = 160;

/// Floor from z = -16 on, wall at z = 9, as wide as 44.
MeshData cove() {
  constexpr float kFloor = -16, kWall = 9, kRadius = 4, kWidth = 44, kHeight = 18;
  const float flat = kWall - kRadius - kFloor, arc = kRadius * kPi / 2, length = flat + arc + kHeight - kRadius;
  const auto section = [=](float s) {
    if (s < flat) return Vec2{kFloor + s, 0};
    const float angle = (s - flat) / kRadius;
    if (s < flat + arc) return Vec2{kWall - kRadius + kRadius * std::sin(angle), kRadius * (1 - std::cos(angle))};
    return Vec2{kWall, kRadius + s - flat - arc};
  };
  return patch(
      1, 240,
      [=](float u, float v) {
        const Vec2 p = section(v * length);
        return Vec3{(0.5f - u) * kWidth, p.y, p.x};
      },
      [=](float u, float v) {
        return Vec2{u * kWidth, v * length};
      });
}

/// From the bottom up, the tray's rim and its inside last.
std::vector<Vec2> side_table() {
  return {{0, 0},         {1.35f, 0},     {1.4f, .02f},   {1.4f, .07f},   {1.3f, .11f},   {.6f, .2f},
          {.22f, .34f},   {.13f, .6f},    {.12f, 2.5f},   {.12f, 4.4f},   {.16f, 4.7f},   {.4f, 4.82f},
          {1.7f, 4.85f},  {1.86f, 4.9f},  {1.93f, 5.04f}, {1.96f, 5.22f}, {1.94f, 5.25f}, {1.91f, 5.22f},
          {1.88f, 5.06f}, {1.82f, 4.97f}, {1.7f, 4.94f},  {0, 4.94f}};
}

/// Up the outside and down the inside, with a thick bottom.
std::vector<Vec2> vase() {
  std::vector<Vec2> profile{{0, 0}, {.36f, 0}, {.42f, .02f}};
  const auto radius = [](float y) {
    return .24f + .36f * std::exp(-std::pow((y - .75f) / .62f, 2.f)) + .05f * std::pow(std::max(y - 1.9f, 0.f), 2.f);
  };
  constexpr int kSteps = 40;
  constexpr float kHeight = 2.9f, kBottom = .22f, kGlass = .055f;
  for (int i = 0; i <= kSteps; ++i) {
    const float y = .06f + (kHeight - .06f) * static_cast<float>(i) / kSteps;
    profile.push_back({radius(y), y});
  }
  profile.push_back({radius(kHeight) - .3f * kGlass, kHeight + .02f});
  profile.push_back({radius(kHeight) - .7f * kGlass, kHeight + .02f});
  for (int i = kSteps; i >= 0; --i) {
    const float y = kBottom + (kHeight - kBottom) * static_cast<float>(i) / kSteps;
    profile.push_back({radius(y) - kGlass, y});
  }
  profile.push_back({.3f, kBottom - .07f});
  profile.push_back({0, kBottom - .1f});
  return profile;
}

}  // namespace

void make_studio(const std::filesystem::path& directory) {
  write_ply(directory / "cove.ply", cove());
  write_ply(directory / "side_table.ply", with_normals(lathe(side_table(), kSides), 40));
  write_ply(directory / "vase.ply", with_normals(lathe(vase(), kSides), 60));
}

}  // namespace dspm
