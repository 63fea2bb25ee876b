// The nave's walls with arcade, blind arcade and upper windows; the outer walls of the aisles; both ends.
#include "dspm/base/math/vec.h"
#include "scenes/generator/hall.h"
#include "scenes/generator/modelling.h"

namespace dspm::hall {
namespace {

constexpr float kTop = 14.6f;         // above all vaults
constexpr float kAisleTop = 7.4f;     // above the aisles' vaults
constexpr float kHalfArcade = 1.95f;  // half an arcade arch's span
constexpr float kOverlap = 0.1f;      // how far walls reach into each other

float bay_middle(int bay) { return pier_x(bay) + 0.5f * kBay; }

Arch arcade_arch(int bay) { return {bay_middle(bay), kHalfArcade, kArcadeSpring, kArcadeSpring, 0.25f, 10}; }
Arch upper_window(int bay) { return {bay_middle(bay), 1.05f, 9.6f, 11.2f, 0.5f, 7}; }
Arch aisle_window(int bay) { return {bay_middle(bay), 1.0f, 1.9f, 4.3f, 0.45f, 7}; }

/// A roll along the edge of an arch, a little in front of the wall.
void add_roll(MeshData& trim, const Wall& wall, const std::vector<Vec2>& outline, float radius, int corners) {
  std::vector<Vec3> path;
  for (const Vec2& p : outline) path.push_back(wall.place(p.x, p.y, 0));
  const Vec3 side = normalize(wall.place(0, 0, 1) - wall.place(0, 0, 0));
  append(trim, sweep(ellipse(radius, radius, corners), path, side));
}

/// A moulding along the whole wall.
void add_course(MeshData& trim, const Wall& wall, float y) {
  const Vec3 side = normalize(wall.place(0, 0, 1) - wall.place(0, 0, 0));
  append(trim, sweep(ellipse(0.12f, 0.08f, 8), {wall.place(wall.s_low, y, 0), wall.place(wall.s_high, y, 0)}, side));
}

/// A post and cross bars before a window's pane.
void add_bars(MeshData& trim, const Wall& wall, const Arch& window, float depth) {
  const float s = window.middle, w = window.half_width, top = window.spring + 1.3f * w;
  append(trim, wall.block({s - 0.05f, window.sill, depth - 0.14f}, {s + 0.05f, top, depth - 0.01f}));
  for (float y = window.sill + 0.9f; y < window.spring + 0.3f * w; y += 0.8f)
    append(trim, wall.block({s - w, y - 0.03f, depth - 0.09f}, {s + w, y + 0.03f, depth - 0.02f}));
}

/// The wall's stone, and its panes of light.
void add_pierced(MeshData& stone, MeshData& panes, const Wall& wall) {
  append(stone, wall.face());
  append(stone, wall.reveals());
  append(panes, wall.panes());
}

void add_windows(MeshData& stone, MeshData& trim, MeshData& panes, Wall wall, Arch window(int)) {
  constexpr float kDepth = 0.55f, kSplay = 0.22f;
  for (int bay = 0; bay < kBays; ++bay) {
    wall.openings.push_back(arched_opening(window(bay), kDepth, kSplay));
    add_bars(trim, wall, window(bay), kDepth);
    add_roll(trim, wall, outline_of(window(bay)), 0.05f, 5);
  }
  add_pierced(stone, panes, wall);
}

/// The storeys of a nave wall, one above the other: arcade, blind arcade, windows.
void add_nave_wall(Parts& parts, MeshData& panes, float side) {
  const auto place = [side](float s, float y, float d) { return Vec3{s, y, side * (kNave + d)}; };
  Wall arcade{-kEnd - kOverlap, kEnd, kArcadeSpring, 7.1f, {}, {}, place};
  Wall behind{arcade.s_low, kEnd, kArcadeSpring, kAisleTop, {}, {}, [side](float s, float y, float d) {
                return Vec3{s, y, side * (kNave + kPierWall - d)};
              }};
  Wall blind{arcade.s_low, kEnd, 7.1f, 9.2f, {}, {}, place};
  const Wall upper{arcade.s_low, kEnd, 9.2f, kTop, {}, {}, place};
  for (int bay = 0; bay < kBays; ++bay) {
    arcade.openings.push_back(arched_opening(arcade_arch(bay), kPierWall));
    behind.openings.push_back(arched_opening(arcade_arch(bay), 0));
    add_roll(parts.trim, arcade, outline_of(arcade_arch(bay)), 0.09f, 5);
    add_roll(parts.trim, behind, outline_of(arcade_arch(bay)), 0.09f, 5);
    for (const float offset : {-1.25f, 0.f, 1.25f}) {
      const Arch niche{bay_middle(bay) + offset, 0.45f, 7.35f, 8.1f, 0.4f, 5};
      blind.openings.push_back(arched_opening(niche, 0.3f));
      add_roll(parts.trim, blind, outline_of(niche), 0.045f, 5);
    }
  }
  append(parts.stone, arcade.face());
  append(parts.stone, arcade.reveals());
  append(parts.stone, behind.face());
  add_pierced(parts.stone, parts.stone, blind);
  add_windows(parts.stone, parts.trim, panes, upper, upper_window);
  add_course(parts.trim, arcade, 7.1f);
  add_course(parts.trim, blind, 9.2f);
}

void add_outer_wall(Parts& parts, MeshData& panes, float side) {
  const Wall wall{-kEnd - kOverlap, kEnd + kOverlap, -0.05f, kAisleTop, {}, {}, [side](float s, float y, float d) {
                    return Vec3{s, y, side * (kAisle + d)};
                  }};
  add_windows(parts.stone, parts.trim, panes, wall, aisle_window);
  add_course(parts.trim, wall, 1.5f);
}

/// The end of an aisle, with one window.
void add_aisle_end(Parts& parts, MeshData& panes, float end, float side) {
  Wall wall{kNave - kOverlap, kAisle + kOverlap, -0.05f, kAisleTop, {}, {}, [=](float s, float y, float d) {
              return Vec3{end * (kEnd - 0.05f + d), y, side * s};
            }};
  Arch window = aisle_window(0);
  window.middle = 0.5f * (kNave + kPierWall + kAisle);
  wall.openings = {arched_opening(window, 0.55f, 0.22f)};
  add_bars(parts.trim, wall, window, 0.55f);
  add_pierced(parts.stone, panes, wall);
}

/// Rings and spokes of stone in the rose window, which is round around `middle`.
void add_tracery(MeshData& trim, const Wall& wall, const Vec2& middle, float radius, float depth) {
  const Vec3 side = normalize(wall.place(0, 0, 1) - wall.place(0, 0, 0));
  const auto ring = [&](const Vec2& centre, float r, float thickness, int steps) {
    std::vector<Vec3> path;
    for (const Vec2& p : circle_outline(centre, r, steps)) path.push_back(wall.place(p.x, p.y, depth));
    append(trim, sweep(ellipse(0.08f, thickness, 6), path, side, true));
  };
  ring(middle, 0.22f * radius, 0.05f, 20);
  ring(middle, 0.62f * radius, 0.04f, 36);
  constexpr int kSpokes = 12;
  const std::vector<Vec2> directions = ellipse(1, 1, 2 * kSpokes);
  for (int i = 0; i < kSpokes; ++i) {
    const Vec2 d = directions[static_cast<std::size_t>(2 * i)],
               between = directions[static_cast<std::size_t>(2 * i + 1)];
    const Vec2 from = middle + d * (0.22f * radius), to = middle + d * (1.02f * radius);
    append(trim,
           sweep(ellipse(0.07f, 0.035f, 6), {wall.place(from.x, from.y, depth), wall.place(to.x, to.y, depth)}, side));
    ring(middle + between * (0.8f * radius), 0.14f * radius, 0.03f, 14);
  }
}

void add_west_end(Parts& parts) {
  constexpr float kRadius = 2.3f, kDepth = 0.5f;
  const Vec2 middle{0, 9.6f};
  Wall wall{-kNave - kOverlap, kNave + kOverlap, -0.05f, kTop, {}, {}, [](float s, float y, float d) {
              return Vec3{-kEnd + 0.05f - d, y, s};
            }};
  wall.openings = {{circle_outline(middle, kRadius, 48), circle_outline(middle, 0.92f * kRadius, 48), kDepth}};
  add_pierced(parts.stone, parts.rose, wall);
  add_tracery(parts.trim, wall, middle, 0.92f * kRadius, kDepth - 0.1f);
}

}  // namespace

void add_walls(Parts& parts) {
  for (const float side : {-1.f, 1.f}) {
    MeshData& panes = side < 0 ? parts.sunny : parts.shady;
    add_nave_wall(parts, panes, side);
    add_outer_wall(parts, panes, side);
    for (const float end : {-1.f, 1.f}) add_aisle_end(parts, panes, end, side);
  }
  add_west_end(parts);
}

}  // namespace dspm::hall
