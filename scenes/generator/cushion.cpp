// Boxed cushions; see surface.h. Their covers are cut as an upholsterer cuts them, so that a pattern runs straight.
#include <array>
#include <cmath>

#include "dspm/base/math/vec.h"
#include "scenes/generator/modelling.h"
#include "scenes/generator/surface.h"

namespace dspm {
namespace {

constexpr int kAround = 240, kAcross = 40, kBand = 16, kCord = 10;

/// The plan: a rectangle with round corners, in equal steps of its length from the middle of the side at +z on.
class Outline {
 public:
  explicit Outline(const Cushion& c)
      : x_(c.half_width - c.corner), z_(c.half_depth - c.corner), corner_(c.corner), arc_(c.corner * kPi / 2) {}

  float length() const { return 4 * (x_ + z_ + arc_); }
  Vec2 at(float u) const {
    float s = (u - std::floor(u)) * length();
    const std::array<float, 4> half_sides{x_, z_, x_, z_};
    for (int quarter = 0;; ++quarter) {
      const float half = half_sides[static_cast<std::size_t>(quarter % 4)];
      const float depth = quarter % 2 == 0 ? z_ : x_;
      const float other = half_sides[static_cast<std::size_t>((quarter + 1) % 4)];
      if (s <= half) return turned({s, depth + corner_}, quarter);
      s -= half;
      if (s <= arc_)
        return turned({half + corner_ * std::sin(s / corner_), depth + corner_ * std::cos(s / corner_)}, quarter);
      s -= arc_;
      if (s <= other) return turned({half + corner_, depth - s}, quarter);
      s -= other;
    }
  }

 private:
  static Vec2 turned(Vec2 p, int quarters) {
    for (int i = 0; i < quarters % 4; ++i) p = {p.y, -p.x};
    return p;
  }

  float x_, z_, corner_, arc_;
};

/// Height of the top over the plan.
float top(const Cushion& c, Vec2 p) {
  const float x = p.x / c.half_width, z = p.y / c.half_depth;
  const auto crown = [](float t) { return 1 - t * t * (0.4f + 0.6f * t * t); };
  return c.half_height + c.bulge * crown(x) * crown(z);
}

}  // namespace

MeshData cushion(const Cushion& c) {
  const Outline outline(c);
  const auto on_plan = [&](float u, float v) { return outline.at(u) * v; };
  MeshData mesh;
  for (const float up : {1.f, -1.f})
    append(mesh, patch(
                     kAround, kAcross,
                     [&](float u, float v) {
                       const Vec2 p = on_plan(up > 0 ? u : 1 - u, 1 - v);
                       return Vec3{p.x, up * top(c, p), p.y};
                     },
                     [&](float u, float v) { return on_plan(up > 0 ? u : 1 - u, 1 - v); }));

  const auto outward = [&](float u) {
    const Vec2 d = outline.at(u + 1e-3f) - outline.at(u - 1e-3f);
    return normalize(Vec3{-d.y, 0, d.x});
  };
  append(mesh, patch(
                   kAround, kBand,
                   [&](float u, float v) {
                     const Vec2 p = outline.at(u);
                     const float t = 2 * v - 1, belly = 0.16f * c.half_height * (1 - t * t);
                     return Vec3{p.x, t * top(c, p), p.y} + outward(u) * belly;
                   },
                   [&](float u, float v) {
                     return Vec2{u * outline.length(), 2 * v * c.half_height};
                   }));
  for (const float up : {1.f, -1.f})
    append(mesh, patch(
                     kAround, kCord,
                     [&](float u, float v) {
                       const Vec2 p = outline.at(u);
                       const float angle = 2 * kPi * v;
                       return Vec3{p.x, up * top(c, p), p.y} + outward(u) * (c.welt * std::cos(angle)) +
                              Vec3{0, c.welt * std::sin(angle), 0};
                     },
                     [&](float u, float v) {
                       return Vec2{u * outline.length(), 0.3f * v};
                     }));
  return mesh;
}

}  // namespace dspm
