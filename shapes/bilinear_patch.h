// A bilinear patch: the surface (1-u)(1-v) p00 + u(1-v) p10 + (1-u)v p01 + uv p11, for CPUs and GPUs. Its four edges are
// straight. bilinearmesh.h has meshes of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/elementary.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/surface_geometry.h"
#include "dspm/shapes/triangle.h"

namespace dspm {

struct BilinearPatch {
  Vec3 p00, p10, p01, p11;

  constexpr DoubleVec3 at(double u, double v) const {
    return mix(mix(widen(p00), widen(p10), u), mix(widen(p01), widen(p11), u), v);
  }
  constexpr DoubleVec3 along_u(double v) const {  // the derivative
    return mix(difference(p10, p00), difference(p11, p01), v);
  }
  constexpr DoubleVec3 along_v(double u) const { return mix(difference(p01, p00), difference(p11, p10), u); }
  /// Returns along_u x along_v; zero in corners and along edges of length zero.
  constexpr DoubleVec3 normal(double u, double v) const { return cross(along_u(v), along_v(u)); }

  /// Returns the nearest hit with t in (0, ray.t_max). Watertight: a ray that passes through an edge that patches or
  /// triangles share hits at least one of them.
  constexpr std::optional<PrimitiveHit> intersect(const Ray& ray) const;
  /// Returns u and v of a point of the patch; nullopt if they cannot be found.
  constexpr std::optional<std::array<double, 2>> parameters(const Vec3& p) const;

  constexpr bool has_area() const;
  constexpr double area() const;
  /// Returns u and v of a point distributed uniformly over the area, and back.
  constexpr std::array<double, 2> uniform(Vec2 numbers) const;
  constexpr Vec2 uniform_numbers(double u, double v) const;

 private:
  static constexpr DoubleVec3 mix(const DoubleVec3& a, const DoubleVec3& b, double share) {
    return a * (1 - share) + b * share;
  }
};

namespace bilinear {

/// Corners in a plane across the ray, which passes through the origin: p00, p10, p11, p01.
struct Outline {
  float x[4], y[4];
};

/// Computes in floats, as the triangle test does, so that all primitives at an edge see the same edge.
constexpr Outline rounded_outline(const BilinearPatch& patch, const TriangleRay& ray) {
  Outline outline;
  const Vec3* const corners[] = {&patch.p00, &patch.p10, &patch.p11, &patch.p01};
  for (int i = 0; i < 4; ++i) {
    const Vec3 a = *corners[i] - ray.origin;
    outline.x[i] = a[ray.kx] - ray.sx * a[ray.kz], outline.y[i] = a[ray.ky] - ray.sy * a[ray.kz];
  }
  return outline;
}

/// Returns how often the outline turns around the ray: 0, 1 or -1. Products of floats are exact in double, so the side
/// of an edge is certain, and the same for both primitives that share it; on an edge, one of them has the ray.
constexpr int turns(const Outline& o) {
  int turns = 0;
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    if ((o.y[i] <= 0) == (o.y[j] <= 0)) continue;
    const double side = double{o.x[i]} * o.y[j] - double{o.y[i]} * o.x[j];
    if (o.y[i] <= 0 && side > 0) ++turns;
    if (o.y[i] > 0 && side < 0) --turns;
  }
  return turns;
}

/// Returns whether the ray passes beside the patch for certain.
constexpr bool is_beside(const Outline& o) {
  const auto [left, right] = std::minmax_element(o.x, o.x + 4);
  const auto [low, high] = std::minmax_element(o.y, o.y + 4);
  return *left > 0 || *right < 0 || *low > 0 || *high < 0;
}

/// A place where the ray may meet the patch.
struct Meeting {
  double u, v;
  double off;  // how far the point with u and v in 0..1 is from the ray, over the size of the outline
  bool inside;
};

struct Meetings {
  Meeting at[2];
  int count = 0;
};

/// The ray meets the segment between the points u of the edges v = 0 and v = 1 if both lie on a line with it: a
/// quadratic equation. [Reshetov 2019, Ray Tracing Gems, ch. 8]
class Crossing {
 public:
  constexpr Crossing(const BilinearPatch& patch, const Vec3& origin, const DoubleVec3& d, int kx, int ky, int kz) {
    const double along[] = {d.x, d.y, d.z};
    const auto place = [&](const Vec3& p) {
      const DoubleVec3 from = difference(p, origin);
      const double a[] = {from.x, from.y, from.z};
      const Point to{a[kx] - along[kx] / along[kz] * a[kz], a[ky] - along[ky] / along[kz] * a[kz]};
      size_ = std::max(std::max(size_, std::abs(to.x)), std::abs(to.y));
      return to;
    };
    p00_ = place(patch.p00), p10_ = place(patch.p10), p01_ = place(patch.p01), p11_ = place(patch.p11);
  }

  /// If `must`, there is a crossing, whatever rounding says.
  constexpr Meetings solve(bool must) const {
    const double c = area(p00_, p01_), all = area(p10_, p11_);
    const double a = area(minus(p10_, p00_), minus(p11_, p01_)), b = all - a - c;
    double discriminant = b * b - 4 * a * c;
    if (must) discriminant = std::max(discriminant, 0.0);
    Meetings found;
    if (!(discriminant >= 0)) return found;
    const double q = -0.5 * (b + elementary::copysign(elementary::sqrt(discriminant), b));
    const auto add = [&](double u) {
      if (u - u == 0) found.at[found.count++] = meeting(u);
    };
    add(q / a), add(c / q);
    return found;
  }

 private:
  struct Point {
    double x, y;
  };
  static constexpr Point minus(const Point& p, const Point& q) { return {p.x - q.x, p.y - q.y}; }
  static constexpr Point mix(const Point& p, const Point& q, double share) {
    return {p.x * (1 - share) + q.x * share, p.y * (1 - share) + q.y * share};
  }
  static constexpr double area(const Point& p, const Point& q) { return p.x * q.y - p.y * q.x; }

  constexpr Meeting meeting(double u) const {
    const double within = std::clamp(u, 0.0, 1.0);
    const Point start = mix(p00_, p10_, within), end = mix(p01_, p11_, within), way = minus(end, start);
    const double length2 = way.x * way.x + way.y * way.y;
    const double v = length2 > 0 ? -(start.x * way.x + start.y * way.y) / length2 : 0.5;
    const Point nearest = mix(start, end, std::clamp(v, 0.0, 1.0));
    return {u, v, std::max(std::abs(nearest.x), std::abs(nearest.y)) / size_, u == within && v >= 0 && v <= 1};
  }

  Point p00_, p10_, p01_, p11_;
  double size_ = 0;
};

/// Gauss-Legendre quadrature of order 8 over [0, to]. [Abramowitz and Stegun 1964, table 25.4]
template <class Integrand>
constexpr double integral(double to, const Integrand& f) {
  constexpr double kNodes[] = {0.0198550717512319, 0.1016667612931866, 0.2372337950418355, 0.4082826787521751,
                               0.5917173212478249, 0.7627662049581645, 0.8983332387068134, 0.9801449282487681};
  constexpr double kWeights[] = {0.0506142681451881, 0.1111905172266872, 0.1568533229389436, 0.1813418916891810,
                                 0.1813418916891810, 0.1568533229389436, 0.1111905172266872, 0.0506142681451881};
  double sum = 0;
  for (int i = 0; i < 8; ++i) sum += kWeights[i] * f(kNodes[i] * to);
  return sum * to;
}

/// Returns the x in [0, 1] with sum(x) = target; `slope` is the derivative of sum. Uses Newton's method, kept within a
/// bracket.
template <class Sum, class Slope>
constexpr double inverse(double target, const Sum& sum, const Slope& slope) {
  double low = 0, high = 1, x = 0.5;
  for (int step = 0; step < 40; ++step) {
    const double excess = sum(x) - target;
    (excess > 0 ? high : low) = x;
    double next = x - excess / slope(x);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) < 1e-9) return next;
    x = next;
  }
  return x;
}

/// The area as a density over u and v: the length of a normal that is linear in both.
class AreaDensity {
 public:
  constexpr explicit AreaDensity(const BilinearPatch& patch)
      : n_(patch.normal(0, 0)), by_u_(patch.normal(1, 0) - n_), by_v_(patch.normal(0, 1) - n_) {}

  constexpr bool is_uniform() const { return dot(by_u_, by_u_) == 0 && dot(by_v_, by_v_) == 0; }
  constexpr double at(double u, double v) const { return length(n_ + by_u_ * u + by_v_ * v); }
  constexpr double up_to_u(double u, double v) const {
    return integral(u, [&](double x) { return at(x, v); });
  }
  constexpr double up_to_v(double v) const {
    return integral(v, [&](double y) { return up_to_u(1, y); });
  }

 private:
  DoubleVec3 n_, by_u_, by_v_;
};

}  // namespace bilinear

// The outline decides in floats whether the ray has to meet the patch. Where, and how far away, is solved in double: a
// ray must not meet the patch that it leaves. If the patch is folded as the ray sees it, two meetings lie beyond the
// outline's turns; if rounding loses these, the ray passes a silhouette, not a crack.
constexpr std::optional<PrimitiveHit> BilinearPatch::intersect(const Ray& ray) const {
  // A meeting at a corner or edge of length zero, which any line seems to meet, is further off than rounding explains.
  constexpr double kFarOff = 1e-6;
  const TriangleRay prepared(ray);
  const bilinear::Outline outline = bilinear::rounded_outline(*this, prepared);
  const bool must = bilinear::turns(outline) != 0;
  if (!must && bilinear::is_beside(outline)) return std::nullopt;
  const DoubleVec3 d = widen(ray.direction), o = widen(ray.origin);
  const bilinear::Meetings meetings =
      bilinear::Crossing(*this, ray.origin, d, prepared.kx, prepared.ky, prepared.kz).solve(must);

  PrimitiveHit nearest{kInfinity, {}};
  const auto offer = [&](const bilinear::Meeting& m) {
    const double u = std::clamp(m.u, 0.0, 1.0), v = std::clamp(m.v, 0.0, 1.0);
    const auto t = static_cast<float>(dot(at(u, v) - o, d) / dot(d, d));
    if (t > 0 && t < ray.t_max && t < nearest.t) nearest = {t, {static_cast<float>(u), static_cast<float>(v)}};
  };
  int best = -1;
  bool any_inside = false;
  for (int i = 0; i < meetings.count; ++i) {
    const bilinear::Meeting& m = meetings.at[i];
    if (m.inside && m.off < kFarOff) offer(m), any_inside = true;
    if (best < 0 || m.off < meetings.at[best].off) best = i;
  }
  if (must && !any_inside && best >= 0) offer(meetings.at[best]);
  if (!(nearest.t < kInfinity) || !has_area()) return std::nullopt;
  return nearest;
}

constexpr std::optional<std::array<double, 2>> BilinearPatch::parameters(const Vec3& p) const {
  const DoubleVec3 n = normal(0.5, 0.5);
  const Vec3 size = abs(narrow(n));
  const int kz = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const bilinear::Meetings meetings = bilinear::Crossing(*this, p, n, (kz + 1) % 3, (kz + 2) % 3, kz).solve(true);
  std::array<double, 2> best{};
  bool found = false;
  double distance = 0.01 * (length(difference(p11, p00)) + length(difference(p10, p01)));
  for (int i = 0; i < meetings.count; ++i) {
    const double u = std::clamp(meetings.at[i].u, 0.0, 1.0), v = std::clamp(meetings.at[i].v, 0.0, 1.0);
    const double off = length(at(u, v) - widen(p));
    if (off < distance) distance = off, best = {u, v}, found = true;
  }
  if (!found) return std::nullopt;
  return best;
}

// The normal is linear in u and v.
constexpr bool BilinearPatch::has_area() const {
  const auto has_length = [](const DoubleVec3& n) { return dot(n, n) > 0; };
  return has_length(normal(0, 0)) || has_length(normal(1, 0)) || has_length(normal(0, 1));
}

constexpr double BilinearPatch::area() const { return bilinear::AreaDensity(*this).up_to_v(1); }

constexpr std::array<double, 2> BilinearPatch::uniform(Vec2 numbers) const {
  const bilinear::AreaDensity density(*this);
  if (density.is_uniform()) return {numbers.x, numbers.y};
  const double v = bilinear::inverse(
      numbers.y * density.up_to_v(1), [&](double y) { return density.up_to_v(y); },
      [&](double y) { return density.up_to_u(1, y); });
  const double u = bilinear::inverse(
      numbers.x * density.up_to_u(1, v), [&](double x) { return density.up_to_u(x, v); },
      [&](double x) { return density.at(x, v); });
  return {u, v};
}

constexpr Vec2 BilinearPatch::uniform_numbers(double u, double v) const {
  const bilinear::AreaDensity density(*this);
  return {static_cast<float>(density.up_to_u(u, v) / density.up_to_u(1, v)),
          static_cast<float>(density.up_to_v(v) / density.up_to_v(1))};
}

}  // namespace dspm
