// Shape "sphere" "float radius" 0.5
//
// A sphere around the origin, or the section of it between two heights and within an angle around z. Its normals point
// outward.
//
// | parameter | default | meaning |
// | --------- | ------- | ------- |
// | radius    | 1       | radius |
// | zmin      | -radius | where the sphere is cut off below |
// | zmax      | radius  | where the sphere is cut off above |
// | phimax    | 360     | the angle that it covers around z (degrees) |
//
// u runs around z from the x axis, v from zmin to zmax. [Pharr, Jakob, Humphreys, Physically Based Rendering, 6.2]
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/shapes/quadric.h"
#include "dspm/shapes/rounding.h"
#include "dspm/shapes/shape.h"

namespace dspm {
namespace {

class Sphere final : public Shape {
 public:
  Sphere(float radius, float z_min, float z_max, const Sweep& sweep)
      : r_(radius),
        z_min_(std::max(z_min, -radius)),
        z_max_(std::min(z_max, radius)),
        theta_min_(std::acos(double{z_min_} / r_)),
        theta_span_(std::acos(double{z_max_} / r_) - theta_min_),
        sweep_(sweep) {}

  Bounds3 bounds(int) const override {
    const float r = r_ * (1 + gamma_bound(4)), slack = r - r_;
    return {{-r, -r, z_min_ - slack}, {r, r, z_max_ + slack}};
  }

  std::optional<PrimitiveHit> intersect(int, const Ray& ray) const override {
    const DoubleVec3 o = widen(ray.origin), d = widen(ray.direction);
    const auto roots = meet_round(o, d, r_);
    if (!roots) return std::nullopt;
    return first_hit(*roots, ray.t_max, [&](double t) { return parameters(o + d * t); });
  }

  SurfacePoint surface_point(int, Vec2 uv) const override {
    const double phi = sweep_.phi(uv.x), c = std::cos(phi), s = std::sin(phi);
    const double theta = theta_min_ + uv.y * theta_span_, rho = std::sin(theta);
    const DoubleVec3 n{rho * c, rho * s, std::cos(theta)};
    SurfacePoint point;
    point.p = narrow(n * r_);
    point.p_error = gamma_bound(2) * abs(point.p);
    point.ng = point.ns = narrow(n);
    point.dpdu = narrow(DoubleVec3{-s, c, 0} * (std::max(rho, kLeastSine) * r_ * sweep_.phi_max()));
    point.dpdv = narrow(DoubleVec3{n.z * c, n.z * s, -rho} * (r_ * theta_span_));
    point.uv = uv;
    return point;
  }

  float area(int) const override { return static_cast<float>(sweep_.phi_max() * r_ * (double{z_max_} - z_min_)); }

  std::optional<float> sphere_radius() const override {
    const bool whole = z_min_ == -r_ && z_max_ == r_ && sweep_.is_whole();
    return whole ? std::optional(r_) : std::nullopt;
  }

  // A sphere's area between two heights is proportional to their distance. [Archimedes]
  Vec2 sample_area(int, Vec2 u) const override {
    const double z = z_min_ + u.y * (double{z_max_} - z_min_), rho = std::sqrt(std::max(0.0, (r_ + z) * (r_ - z)));
    return {u.x, v_of(rho, z)};
  }
  std::optional<Vec2> area_numbers(int, const Vec3& p) const override {
    const auto u = sweep_.u_of(p.x, p.y);
    if (!u) return std::nullopt;
    return Vec2{*u, static_cast<float>((p.z - double{z_min_}) / (double{z_max_} - z_min_))};
  }

 private:
  std::optional<Vec2> parameters(const DoubleVec3& p) const {
    const double z = p.z * (r_ / length(p));
    if ((z < z_min_ && z_min_ > -r_) || (z > z_max_ && z_max_ < r_))
      return std::nullopt;  // rounding must not cut poles
    const auto u = sweep_.u_of(p.x, p.y);
    if (!u) return std::nullopt;
    return Vec2{*u, v_of(std::hypot(p.x, p.y), p.z)};
  }

  float v_of(double rho, double z) const {
    return static_cast<float>(std::clamp((std::atan2(rho, z) - theta_min_) / theta_span_, 0.0, 1.0));
  }

  float r_, z_min_, z_max_;
  double theta_min_, theta_span_;  // v runs from 0 to 1 as the angle to the z axis runs from theta_min on
  Sweep sweep_;
};

}  // namespace

std::vector<MadeShape> make_sphere(ParamReader& reader) {
  const float radius = read_positive(reader, "radius", 1, "radius");
  const float z0 = reader.number("zmin", -radius, "scene units", "where the sphere is cut off below");
  const float z1 = reader.number("zmax", radius, "scene units", "where the sphere is cut off above");
  const Sweep sweep(reader);
  reader.finish();

  const auto [z_min, z_max] = std::minmax(z0, z1);
  std::vector<MadeShape> made;
  if (z_min == z_max || z_min >= radius || z_max <= -radius)
    reader.error("zmin", "nothing of the sphere is left between \"zmin\" and \"zmax\"");
  else
    made.push_back({std::make_unique<Sphere>(radius, z_min, z_max, sweep), std::nullopt});
  return made;
}

}  // namespace dspm
