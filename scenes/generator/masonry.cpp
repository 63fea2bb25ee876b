#include "scenes/generator/masonry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "dspm/base/math/vec.h"
#include "scenes/generator/modelling.h"

namespace dspm {
namespace {

/// Quads in the wall's coordinates become faces that look at d < 0, whichever way the wall's coordinates turn.
class Builder {
 public:
  explicit Builder(const Wall& wall) : place_(wall.place) {
    const float s = 0.5f * (wall.s_low + wall.s_high), y = 0.5f * (wall.y_low + wall.y_high), step = 1e-2f;
    const Vec3 origin = place_(s, y, 0);
    const Vec3 normal = cross(place_(s + step, y, 0) - origin, place_(s, y + step, 0) - origin);
    mirrored_ = dot(normal, place_(s, y, step) - origin) > 0;
  }
  /// Counterclockwise where s goes right and y up; corners may coincide.
  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  MeshData take() { return std::move(mesh_); }

 private:
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    if (a == b || b == c || c == a) return;
    const int i = vertex(a), j = vertex(b), k = vertex(c);
    mesh_.faces.push_back(mirrored_ ? Face{i, k, j} : Face{i, j, k});
  }
  int vertex(const Vec3& p) {
    const auto [at, is_new] = vertices_.try_emplace({p.x, p.y, p.z}, static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(place_(p.x, p.y, p.z));
    return at->second;
  }

  const WallPlace& place_;
  bool mirrored_ = false;
  MeshData mesh_;
  std::map<std::tuple<float, float, float>, int> vertices_;
};

float mix(float a, float b, float t) { return a + t * (b - a); }
Vec2 mix(Vec2 a, Vec2 b, float t) { return {mix(a.x, b.x, t), mix(a.y, b.y, t)}; }

/// The heights between which an outline is open above s0 and s1, neighbours among the breaks.
struct Gap {
  float low0, low1, high0, high1;
};
std::optional<Gap> gap_between(const std::vector<Vec2>& outline, float s0, float s1) {
  std::vector<Vec2> crossings;  // heights at s0 and s1
  for (std::size_t i = 0; i < outline.size(); ++i) {
    Vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    if (a.x > b.x) std::swap(a, b);
    if (a.x > s0 || b.x < s1) continue;
    const auto height = [&](float s) {
      return s == a.x ? a.y : s == b.x ? b.y : mix(a.y, b.y, (s - a.x) / (b.x - a.x));
    };
    crossings.push_back({height(s0), height(s1)});
  }
  if (crossings.size() != 2) return std::nullopt;
  if (crossings[0].x + crossings[0].y > crossings[1].x + crossings[1].y) std::swap(crossings[0], crossings[1]);
  return Gap{crossings[0].x, crossings[0].y, crossings[1].x, crossings[1].y};
}

/// All places along the wall where something begins, ends or bends.
std::vector<float> all_breaks(const Wall& wall) {
  std::vector<float> all = wall.breaks;
  all.insert(all.end(), {wall.s_low, wall.s_high});
  for (const Opening& opening : wall.openings)
    for (const Vec2& p : opening.outline) all.push_back(p.x);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// The opening with a point wherever its outline crosses a break, so that face and reveal have the same vertices.
Opening refined(const Opening& opening, const std::vector<float>& breaks) {
  Opening result{{}, {}, opening.depth};
  for (std::size_t i = 0; i < opening.outline.size(); ++i) {
    const std::size_t next = (i + 1) % opening.outline.size();
    const Vec2 a = opening.outline[i], b = opening.outline[next];
    result.outline.push_back(a);
    result.inner.push_back(opening.inner[i]);
    std::vector<float> inside;
    for (const float s : breaks)
      if (std::min(a.x, b.x) < s && s < std::max(a.x, b.x)) inside.push_back(s);
    if (a.x > b.x) std::reverse(inside.begin(), inside.end());
    for (const float s : inside) {
      const float t = (s - a.x) / (b.x - a.x);
      result.outline.push_back({s, mix(a.y, b.y, t)});
      result.inner.push_back(mix(opening.inner[i], opening.inner[next], t));
    }
  }
  return result;
}

std::vector<Opening> refined(const std::vector<Opening>& openings, const std::vector<float>& breaks) {
  std::vector<Opening> result;
  for (const Opening& opening : openings) result.push_back(refined(opening, breaks));
  return result;
}

}  // namespace

float arch_height(float t, float pointedness) {
  const float radius = 1 + pointedness, x = std::min(t, 1.f) + pointedness;
  return std::sqrt(std::max(0.f, radius * radius - x * x) / (1 + 2 * pointedness));
}

std::vector<float> arch_places(float pointedness, int count) {
  const float last = std::acos(pointedness / (1 + pointedness));
  std::vector<float> places;
  for (int i = 0; i < count; ++i)
    places.push_back((1 + pointedness) * std::cos(last * static_cast<float>(i) / static_cast<float>(count)) -
                     pointedness);
  places.push_back(0);
  return places;
}

std::vector<Vec2> outline_of(const Arch& arch) {
  const float rise = arch.half_width * std::sqrt(1 + 2 * arch.pointedness);
  const auto point = [&](float t) {
    return Vec2{arch.middle + t * arch.half_width, arch.spring + rise * arch_height(std::abs(t), arch.pointedness)};
  };
  const std::vector<float> places = arch_places(arch.pointedness, arch.steps);
  std::vector<Vec2> outline;
  if (arch.sill < arch.spring) outline.push_back({arch.middle - arch.half_width, arch.sill});
  for (const float t : places) outline.push_back(point(-t));
  for (auto t = places.rbegin() + 1; t != places.rend(); ++t) outline.push_back(point(*t));
  if (arch.sill < arch.spring) outline.push_back({arch.middle + arch.half_width, arch.sill});
  return outline;
}

std::vector<Vec2> circle_outline(const Vec2& middle, float radius, int steps) {
  std::vector<Vec2> outline = ellipse(radius, radius, steps);
  for (Vec2& p : outline) p = p + middle;
  std::reverse(outline.begin(), outline.end());
  return outline;
}

Opening arched_opening(const Arch& arch, float depth, float splay) {
  Arch narrow = arch;
  narrow.half_width -= splay;
  narrow.sill += splay;
  return {outline_of(arch), outline_of(narrow), depth};
}

MeshData Wall::face() const {
  Builder builder(*this);
  const std::vector<float> all = all_breaks(*this);
  const std::vector<Opening> fine = refined(openings, all);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const float s0 = all[i], s1 = all[i + 1];
    std::vector<Gap> gaps{{y_high, y_high, y_high, y_high}};
    for (const Opening& opening : fine)
      if (const auto gap = gap_between(opening.outline, s0, s1)) gaps.push_back(*gap);
    std::sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.low0 + a.low1 < b.low0 + b.low1; });
    float y0 = y_low, y1 = y_low;
    for (const Gap& gap : gaps) {
      builder.quad({s0, y0, 0}, {s1, y1, 0}, {s1, gap.low1, 0}, {s0, gap.low0, 0});
      y0 = gap.high0, y1 = gap.high1;
    }
  }
  return builder.take();
}

MeshData Wall::reveals() const {
  Builder builder(*this);
  for (const Opening& opening : refined(openings, all_breaks(*this)))
    for (std::size_t i = 0; i < opening.outline.size(); ++i) {
      const std::size_t next = (i + 1) % opening.outline.size();
      const Vec2 a = opening.outline[i], b = opening.outline[next], c = opening.inner[next], d = opening.inner[i];
      if (a.y == y_low && b.y == y_low) continue;  // an arcade has no sill
      builder.quad({b.x, b.y, 0}, {a.x, a.y, 0}, {d.x, d.y, opening.depth}, {c.x, c.y, opening.depth});
    }
  return builder.take();
}

MeshData Wall::panes() const {
  Builder builder(*this);
  for (const Opening& opening : openings) {
    std::vector<float> all;
    for (const Vec2& p : opening.inner) all.push_back(p.x);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      if (const auto gap = gap_between(opening.inner, all[i], all[i + 1]))
        builder.quad({all[i], gap->low0, opening.depth}, {all[i + 1], gap->low1, opening.depth},
                     {all[i + 1], gap->high1, opening.depth}, {all[i], gap->high0, opening.depth});
  }
  return builder.take();
}

MeshData Wall::block(const Vec3& low, const Vec3& high) const {
  MeshData mesh = box(low, high);
  const Vec3 origin = place(low.x, low.y, low.z);
  const Vec3 along_s = place(high.x, low.y, low.z) - origin, along_y = place(low.x, high.y, low.z) - origin;
  const bool mirrored = dot(cross(along_s, along_y), place(low.x, low.y, high.z) - origin) < 0;
  for (Vec3& p : mesh.vertices) p = place(p.x, p.y, p.z);
  if (mirrored)
    for (Face& face : mesh.faces) std::swap(face[1], face[2]);
  return mesh;
}

}  // namespace dspm
