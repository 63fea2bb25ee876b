#include "dspm/shapes/bilinear_patch.h"

#include <algorithm>
#include <cmath>

#include "dspm/shapes/triangle.h"

namespace dspm {
namespace {

DoubleVec3 mix(const DoubleVec3& a, const DoubleVec3& b, double share) { return a * (1 - share) + b * share; }

/// Corners in a plane across the ray, which passes through the origin: p00, p10, p11, p01.
template <class Number>
struct Outline {
  Number x[4], y[4];
};

/// Computes in floats, as the triangle test does, so that all primitives at an edge see the same edge.
Outline<float> rounded_outline(const BilinearPatch& patch, const TriangleRay& ray) {
  Outline<float> outline;
  const Vec3* corners[] = {&patch.p00, &patch.p10, &patch.p11, &patch.p01};
  for (int i = 0; i < 4; ++i) {
    const Vec3 a = *corners[i] - ray.origin;
    outline.x[i] = a[ray.kx] - ray.sx * a[ray.kz], outline.y[i] = a[ray.ky] - ray.sy * a[ray.kz];
  }
  return outline;
}

/// Returns how often the outline turns around the ray: 0, 1 or -1. Products of floats are exact in double, so the side
/// of an edge is certain, and the same for both primitives that share it; on an edge, one of them has the ray.
int turns(const Outline<float>& o) {
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
bool is_beside(const Outline<float>& o) {
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
  Crossing(const BilinearPatch& patch, const Vec3& origin, const DoubleVec3& d, int kx, int ky, int kz) {
    const double along[] = {d.x, d.y, d.z};
    const auto place = [&](const Vec3& p, Point& to) {
      const DoubleVec3 from = difference(p, origin);
      const double a[] = {from.x, from.y, from.z};
      to = {a[kx] - along[kx] / along[kz] * a[kz], a[ky] - along[ky] / along[kz] * a[kz]};
      size_ = std::max({size_, std::abs(to.x), std::abs(to.y)});
    };
    place(patch.p00, p00_), place(patch.p10, p10_), place(patch.p01, p01_), place(patch.p11, p11_);
  }

  /// If `must`, there is a crossing, whatever rounding says.
  Meetings solve(bool must) const {
    const double c = area(p00_, p01_), all = area(p10_, p11_);
    const double a = area(minus(p10_, p00_), minus(p11_, p01_)), b = all - a - c;
    double discriminant = b * b - 4 * a * c;
    if (must) discriminant = std::max(discriminant, 0.0);
    Meetings found;
    if (!(discriminant >= 0)) return found;
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    for (const double u : {q / a, c / q})
      if (std::isfinite(u)) found.at[found.count++] = meeting(u);
    return found;
  }

 private:
  struct Point {
    double x, y;
  };
  static Point minus(const Point& p, const Point& q) { return {p.x - q.x, p.y - q.y}; }
  static Point mix(const Point& p, const Point& q, double share) {
    return {p.x * (1 - share) + q.x * share, p.y * (1 - share) + q.y * share};
  }
  static double area(const Point& p, const Point& q) { return p.x * q.y - p.y * q.x; }

  Meeting meeting(double u) const {
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

// A meeting at a corner or edge of length zero, which any line seems to meet, is further off than rounding explains.
constexpr double kFarOff = 1e-6;

// Gauss-Legendre quadrature of order 8 over [0, 1]. [Abramowitz and Stegun 1964, table 25.4]
constexpr double kNodes[] = {0.0198550717512319, 0.1016667612931866, 0.2372337950418355, 0.4082826787521751,
                             0.5917173212478249, 0.7627662049581645, 0.8983332387068134, 0.9801449282487681};
constexpr double kWeights[] = {0.0506142681451881, 0.1111905172266872, 0.1568533229389436, 0.1813418916891810,
                               0.1813418916891810, 0.1568533229389436, 0.1111905172266872, 0.0506142681451881};

template <class Integrand>
double integral(double to, const Integrand& f) {
  double sum = 0;
  for (int i = 0; i < 8; ++i) sum += kWeights[i] * f(kNodes[i] * to);
  return sum * to;
}

/// Returns the x in [0, 1] with sum(x) = target; `slope` is the derivative of sum. Uses Newton's method, kept within a
/// bracket.
template <class Sum, class Slope>
double inverse(double target, const Sum& sum, const Slope& slope) {
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
  explicit AreaDensity(const BilinearPatch& patch)
      : n_(patch.normal(0, 0)), by_u_(patch.normal(1, 0) - n_), by_v_(patch.normal(0, 1) - n_) {}

  bool is_uniform() const { return dot(by_u_, by_u_) == 0 && dot(by_v_, by_v_) == 0; }
  double at(double u, double v) const { return length(n_ + by_u_ * u + by_v_ * v); }
  double up_to_u(double u, double v) const {
    return integral(u, [&](double x) { return at(x, v); });
  }
  double up_to_v(double v) const {
    return integral(v, [&](double y) { return up_to_u(1, y); });
  }

 private:
  DoubleVec3 n_, by_u_, by_v_;
};

}  // namespace

DoubleVec3 BilinearPatch::at(double u, double v) const {
  return mix(mix(widen(p00), widen(p10), u), mix(widen(p01), widen(p11), u), v);
}
DoubleVec3 BilinearPatch::along_u(double v) const { return mix(difference(p10, p00), difference(p11, p01), v); }
DoubleVec3 BilinearPatch::along_v(double u) const { return mix(difference(p01, p00), difference(p11, p10), u); }

// The outline decides in floats whether the ray has to meet the patch. Where, and how far away, is solved in double: a
// ray must not meet the patch that it leaves. If the patch is folded as the ray sees it, two meetings lie beyond the
// outline's turns; if rounding loses these, the ray passes a silhouette, not a crack.
std::optional<PrimitiveHit> BilinearPatch::intersect(const Ray& ray) const {
  const TriangleRay prepared(ray);
  const Outline<float> outline = rounded_outline(*this, prepared);
  const bool must = turns(outline) != 0;
  if (!must && is_beside(outline)) return std::nullopt;
  const DoubleVec3 d = widen(ray.direction), o = widen(ray.origin);
  const Meetings meetings = Crossing(*this, ray.origin, d, prepared.kx, prepared.ky, prepared.kz).solve(must);

  std::optional<PrimitiveHit> nearest;
  const auto offer = [&](const Meeting& m) {
    const double u = std::clamp(m.u, 0.0, 1.0), v = std::clamp(m.v, 0.0, 1.0);
    const auto t = static_cast<float>(dot(at(u, v) - o, d) / dot(d, d));
    if (t > 0 && t < ray.t_max && t < kInfinity && (!nearest || t < nearest->t))
      nearest = {t, {static_cast<float>(u), static_cast<float>(v)}};
  };
  const Meeting* best = nullptr;
  bool any_inside = false;
  for (int i = 0; i < meetings.count; ++i) {
    const Meeting& m = meetings.at[i];
    if (m.inside && m.off < kFarOff) offer(m), any_inside = true;
    if (best == nullptr || m.off < best->off) best = &m;
  }
  if (must && !any_inside && best != nullptr) offer(*best);
  return nearest && has_area() ? nearest : std::nullopt;
}

// The normal is linear in u and v.
bool BilinearPatch::has_area() const {
  const DoubleVec3 corners[] = {normal(0, 0), normal(1, 0), normal(0, 1)};
  return std::any_of(corners, corners + 3, [](const DoubleVec3& n) { return dot(n, n) > 0; });
}

std::optional<std::array<double, 2>> BilinearPatch::parameters(const Vec3& p) const {
  const DoubleVec3 n = normal(0.5, 0.5);
  const Vec3 size = abs(narrow(n));
  const int kz = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const Meetings meetings = Crossing(*this, p, n, (kz + 1) % 3, (kz + 2) % 3, kz).solve(true);
  std::optional<std::array<double, 2>> best;
  double distance = 0.01 * (length(difference(p11, p00)) + length(difference(p10, p01)));
  for (int i = 0; i < meetings.count; ++i) {
    const double u = std::clamp(meetings.at[i].u, 0.0, 1.0), v = std::clamp(meetings.at[i].v, 0.0, 1.0);
    const double off = length(at(u, v) - widen(p));
    if (off < distance) distance = off, best = {u, v};
  }
  return best;
}

double BilinearPatch::area() const { return AreaDensity(*this).up_to_v(1); }

std::array<double, 2> BilinearPatch::uniform(Vec2 numbers) const {
  const AreaDensity density(*this);
  if (density.is_uniform()) return {numbers.x, numbers.y};
  const double v = inverse(
      numbers.y * density.up_to_v(1), [&](double y) { return density.up_to_v(y); },
      [&](double y) { return density.up_to_u(1, y); });
  const double u = inverse(
      numbers.x * density.up_to_u(1, v), [&](double x) { return density.up_to_u(x, v); },
      [&](double x) { return density.at(x, v); });
  return {u, v};
}

Vec2 BilinearPatch::uniform_numbers(double u, double v) const {
  const AreaDensity density(*this);
  return {static_cast<float>(density.up_to_u(u, v) / density.up_to_u(1, v)),
          static_cast<float>(density.up_to_v(v) / density.up_to_v(1))};
}

}  // namespace dspm
