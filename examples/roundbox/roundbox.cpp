// Shape "roundbox" "vector3 size" [2 1 1] "float radius" 0.2
//
// A box with round edges and corners, intersected by sphere tracing its distance function: no triangles, no formula for
// the hit. A box with half sides b, grown by r, is where the distance to the box is r. [Hart 1996, Sphere tracing]
//
//   size    vector3  2 2 2   sides, rounding included
//   radius  float    0.1     of the edges; at most half the shortest side
//
// Only two numbers say later where a ray hit the surface, so they must identify the point: the whole surface is visible
// from the middle, and (u, v) are the angles of the direction to the point.
#include <dspm/base/math/double_vec.h>
#include <dspm/session/modules/module.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace dspm;

constexpr double kTwoPi = 2 * 3.14159265358979323846;

class RoundBox final : public Shape {
 public:
  RoundBox(const Vec3& half_size, float radius)
      : box_{double{half_size.x} - radius, double{half_size.y} - radius, double{half_size.z} - radius},
        radius_(radius),
        reach_(length(widen(half_size))) {}

  Bounds3 bounds(int) const override {
    const auto side = [&](double b) { return static_cast<float>((b + radius_) * (1 + 1e-6)); };
    const Vec3 corner{side(box_.x), side(box_.y), side(box_.z)};
    return {-corner, corner};
  }

  std::optional<PrimitiveHit> intersect(int, const Ray& ray) const override {
    const DoubleVec3 o = widen(ray.origin), d = widen(ray.direction);
    const double speed = length(d), middle = -dot(o, d) / (speed * speed), half = reach_ / speed;
    // From far away, sphere tracing would lose precision, so it starts where the ball around the box begins.
    double t = std::max(0.0, middle - half);
    const double end = std::min(double{ray.t_max}, middle + half);
    if (!(t < end)) return std::nullopt;
    const auto at = [&](double s) { return distance(o + d * s); };
    const double side = at(t) < 0 ? -1 : 1;
    for (int step = 0; step < kSteps && t < end; ++step) {
      const double gap = side * at(t);
      if (gap < kClose * reach_) break;
      t += gap / speed;
    }
    if (!(t < end)) return std::nullopt;
    const auto crossing = find_crossing(at, side, t, end);
    return crossing ? hit_at(o + d * *crossing, *crossing, ray) : std::nullopt;
  }

  SurfacePoint surface_point(int, Vec2 uv) const override {
    const double phi = kTwoPi * uv.x, theta = kTwoPi / 2 * uv.y, rho = std::sin(theta);
    const DoubleVec3 direction{rho * std::cos(phi), rho * std::sin(phi), std::cos(theta)};
    double low = 0, high = reach_ * 1.01;  // the surface lies between, as all of it is visible from the middle
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (distance(direction * middle) < 0 ? low : high) = middle;
    }
    SurfacePoint point;
    const DoubleVec3 p = direction * low, n = normal(p);
    point.p = narrow(p);
    const auto error = static_cast<float>(1e-6 * reach_);
    point.p_error = {error, error, error};
    point.ng = point.ns = narrow(n);
    point.uv = uv;
    const DoubleVec3 by_phi{-rho * std::sin(phi), rho * std::cos(phi), 0};
    const DoubleVec3 by_theta{std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -rho};
    const auto turn = kTwoPi * low, per_v = turn / 2;
    point.dpdu = along_surface(direction, n, by_phi * turn), point.dpdv = along_surface(direction, n, by_theta * per_v);
    if (!(length2(point.dpdu) > 0)) point.dpdu = Basis::around(point.ng).x, point.dpdv = {};  // at a pole
    return point;
  }

  float area(int) const override { return static_cast<float>(faces() + edges() + corners()); }

  Vec2 sample_area(int, Vec2 u) const override {
    const double at = u.x * (faces() + edges() + corners());
    if (at < faces()) return uv_of(on_a_face(at / faces(), u.y));
    if (at < faces() + edges()) return uv_of(on_an_edge((at - faces()) / edges(), u.y));
    return uv_of(on_a_corner((at - faces() - edges()) / corners(), u.y));
  }

 private:
  static constexpr int kSteps = 32;
  static constexpr double kClose = 1e-9;  // to the surface, as a fraction of the shape's reach

  /// Negative inside.
  double distance(const DoubleVec3& p) const {
    const DoubleVec3 q{std::abs(p.x) - box_.x, std::abs(p.y) - box_.y, std::abs(p.z) - box_.z};
    const DoubleVec3 outside{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
    return length(outside) + std::min(std::max({q.x, q.y, q.z}), 0.0) - radius_;
  }
  DoubleVec3 normal(const DoubleVec3& p) const {
    const double h = 1e-6 * reach_;
    const auto slope = [&](const DoubleVec3& axis) { return distance(p + axis * h) - distance(p + axis * -h); };
    const DoubleVec3 n{slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1})};
    return n * (1 / length(n));
  }

  /// How a point of the surface moves if the direction from the middle turns so: it stays on the tangent plane.
  static Vec3 along_surface(const DoubleVec3& direction, const DoubleVec3& n, const DoubleVec3& turned) {
    return narrow(turned + direction * (-dot(n, turned) / dot(n, direction)));
  }

  /// The first change of sign in [begin, end], where `side` times the distance is not negative at `begin`. Decides
  /// grazing rays, too, along which sphere tracing creeps.
  template <class At>
  static std::optional<double> find_crossing(const At& at, double side, double begin, double end) {
    double beyond = side > 0 ? place_of_least(at, begin, end) : end;
    if (side * at(beyond) >= 0) return std::nullopt;
    for (int i = 0; i < 60; ++i) {
      const double middle = (begin + beyond) / 2;
      (side * at(middle) >= 0 ? begin : beyond) = middle;
    }
    return begin;
  }
  /// Along a ray the distance to a convex body falls, then rises.
  template <class At>
  static double place_of_least(const At& at, double low, double high) {
    for (int i = 0; i < 80; ++i) {
      const double third = (high - low) / 3, a = low + third, b = high - third;
      if (at(a) < at(b))
        high = b;
      else
        low = a;
    }
    return (low + high) / 2;
  }
  static std::optional<PrimitiveHit> hit_at(const DoubleVec3& p, double t, const Ray& ray) {
    const auto rounded = static_cast<float>(t);
    if (!(rounded > 0 && rounded < ray.t_max)) return std::nullopt;
    return PrimitiveHit{rounded, uv_of(p)};
  }
  static Vec2 uv_of(const DoubleVec3& p) {
    const double phi = std::atan2(p.y, p.x), theta = std::atan2(std::hypot(p.x, p.y), p.z);
    return {static_cast<float>(phi < 0 ? phi / kTwoPi + 1 : phi / kTwoPi), static_cast<float>(theta / (kTwoPi / 2))};
  }

  double faces() const { return 8 * (box_.x * box_.y + box_.y * box_.z + box_.z * box_.x); }
  double edges() const { return 2 * kTwoPi * radius_ * (box_.x + box_.y + box_.z); }
  double corners() const { return 2 * kTwoPi * radius_ * radius_; }

  /// One of three axes, chosen by weight, and one of its two sides; `rest` is what remains of `u`.
  struct Axis {
    int axis;
    double sign, rest;
  };
  static Axis choose_axis(double u, double x, double y, double z) {
    const double weights[] = {x, y, z};
    double at = u * (x + y + z);
    int axis = 0;
    while (axis < 2 && at >= weights[axis]) at -= weights[axis++];
    const double half = 2 * at / weights[axis];
    return {axis, half < 1 ? -1.0 : 1.0, half < 1 ? half : half - 1};
  }
  /// Coordinates with the chosen axis first.
  static DoubleVec3 along(int axis, double first, double second, double third) {
    return axis == 0   ? DoubleVec3{first, second, third}
           : axis == 1 ? DoubleVec3{third, first, second}
                       : DoubleVec3{second, third, first};
  }
  double half(int axis) const { return axis % 3 == 0 ? box_.x : axis % 3 == 1 ? box_.y : box_.z; }

  DoubleVec3 on_a_face(double u, double v) const {
    const auto [axis, sign, rest] = choose_axis(u, box_.y * box_.z, box_.z * box_.x, box_.x * box_.y);
    return along(axis, sign * (half(axis) + radius_), (2 * rest - 1) * half(axis + 1), (2 * v - 1) * half(axis + 2));
  }
  DoubleVec3 on_an_edge(double u, double v) const {
    const auto [axis, sign, rest] = choose_axis(u, box_.x, box_.y, box_.z);
    const double phi = kTwoPi * v, c = std::cos(phi), s = std::sin(phi);
    const auto off = [&](double b, double part) { return std::copysign(b, part) + radius_ * part; };
    return along(axis, sign * rest * half(axis), off(half(axis + 1), c), off(half(axis + 2), s));
  }
  DoubleVec3 on_a_corner(double u, double v) const {
    const double z = 2 * u - 1, rho = std::sqrt(std::max(0.0, 1 - z * z)), phi = kTwoPi * v;
    const double x = rho * std::cos(phi), y = rho * std::sin(phi);
    const auto off = [&](double b, double part) { return std::copysign(b, part) + radius_ * part; };
    return {off(box_.x, x), off(box_.y, y), off(box_.z, z)};
  }

  DoubleVec3 box_;  // half its sides, before it is grown
  double radius_;
  double reach_;  // of the farthest point from the middle, at most
};

std::vector<MadeShape> make_roundbox(ParamReader& reader) {
  const Vec3 size = reader.vector("size", {2, 2, 2}, "scene units", "sides, rounding included");
  const float radius = reader.number("radius", 0.1f, "scene units", "of the edges; at most half the shortest side");
  reader.finish();
  std::vector<MadeShape> made;
  const float shortest = std::min({size.x, size.y, size.z});
  if (!(shortest > 0))
    reader.error("size", "the sides must be above 0");
  else if (!(radius > 0 && radius <= shortest / 2))
    reader.error("radius", "the radius must be above 0 and at most half the shortest side");
  else
    made.push_back({std::make_unique<RoundBox>(size * 0.5f, radius), std::nullopt});
  return made;
}

}  // namespace

DSPM_MODULE(registry) {
  registry.add(shape_plugins(), {"roundbox", "a box with round edges, by sphere tracing", make_roundbox});
}
