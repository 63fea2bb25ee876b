// The surface of a sphere, or of the section of it that "sphere" describes (sphere.cpp), for CPUs and GPUs.
#pragma once

#include <algorithm>
#include <concepts>
#include <optional>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/elementary.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounding.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/quadric.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

class SphereSurface {
 public:
  constexpr SphereSurface(float radius, float z_min, float z_max, const Sweep& sweep)
      : r_(radius),
        z_min_(std::max(z_min, -radius)),
        z_max_(std::min(z_max, radius)),
        theta_min_(elementary::acos(double{z_min_} / r_)),
        theta_span_(elementary::acos(double{z_max_} / r_) - theta_min_),
        sweep_(sweep) {}

  constexpr float radius() const { return r_; }
  constexpr bool is_whole() const { return z_min_ == -r_ && z_max_ == r_ && sweep_.is_whole(); }

  constexpr Bounds3 bounds() const {
    const float r = r_ * (1 + gamma_bound(4)), slack = r - r_;
    return {{-r, -r, z_min_ - slack}, {r, r, z_max_ + slack}};
  }

  constexpr std::optional<PrimitiveHit> intersect(const Ray& ray) const {
    const DoubleVec3 o = widen(ray.origin), d = widen(ray.direction);
    const auto roots = meet_round(o, d, r_);
    if (!roots) return std::nullopt;
    return first_hit(*roots, ray.t_max, [&](double t) { return parameters(o + d * t); });
  }

  template <std::derived_from<SurfaceGeometry> Point = SurfaceGeometry>
  constexpr Point surface_point(Vec2 uv) const {
    const auto [s, c] = elementary::sin_cos(sweep_.phi(uv.x));
    const auto [rho, height] = elementary::sin_cos(theta_min_ + uv.y * theta_span_);
    const DoubleVec3 n{rho * c, rho * s, height};
    Point point;
    point.p = narrow(n * r_);
    point.p_error = gamma_bound(2) * abs(point.p);
    point.ng = point.ns = narrow(n);
    point.dpdu = narrow(DoubleVec3{-s, c, 0} * (at_least(rho, kLeastSine) * r_ * sweep_.phi_max()));
    point.dpdv = narrow(DoubleVec3{n.z * c, n.z * s, -rho} * (r_ * theta_span_));
    point.uv = uv;
    return point;
  }

  constexpr float area() const { return static_cast<float>(sweep_.phi_max() * r_ * (double{z_max_} - z_min_)); }

  // A sphere's area between two heights is proportional to their distance. [Archimedes]
  constexpr Vec2 sample_area(Vec2 u) const {
    const double z = z_min_ + u.y * (double{z_max_} - z_min_);
    return {u.x, v_of(elementary::sqrt(std::max(0.0, (r_ + z) * (r_ - z))), z)};
  }
  constexpr std::optional<Vec2> area_numbers(const Vec3& p) const {
    const auto u = sweep_.u_of(p.x, p.y);
    if (!u) return std::nullopt;
    return Vec2{*u, static_cast<float>((p.z - double{z_min_}) / (double{z_max_} - z_min_))};
  }

 private:
  constexpr std::optional<Vec2> parameters(const DoubleVec3& p) const {
    const double z = p.z * (r_ / length(p));
    if ((z < z_min_ && z_min_ > -r_) || (z > z_max_ && z_max_ < r_))
      return std::nullopt;  // rounding must not cut poles
    const auto u = sweep_.u_of(p.x, p.y);
    if (!u) return std::nullopt;
    return Vec2{*u, v_of(elementary::hypot(p.x, p.y), p.z)};
  }

  constexpr float v_of(double rho, double z) const {
    return static_cast<float>(std::clamp((elementary::atan2(rho, z) - theta_min_) / theta_span_, 0.0, 1.0));
  }

  float r_, z_min_, z_max_;
  double theta_min_, theta_span_;  // v runs from 0 to 1 as the angle to the z axis runs from theta_min on
  Sweep sweep_;
};

}  // namespace dspm
