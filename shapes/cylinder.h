// The surface of a cylinder as "cylinder" describes it (cylinder.cpp), for CPUs and GPUs.
#pragma once

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

class CylinderSurface {
 public:
  constexpr CylinderSurface(float radius, float z_min, float z_max, const Sweep& sweep)
      : r_(radius), z_min_(z_min), z_max_(z_max), sweep_(sweep) {}

  constexpr Bounds3 bounds() const {
    const float r = r_ * (1 + gamma_bound(4));
    return {{-r, -r, z_min_}, {r, r, z_max_}};
  }

  constexpr std::optional<PrimitiveHit> intersect(const Ray& ray) const {
    const DoubleVec3 o = widen(ray.origin), d = widen(ray.direction);
    const auto roots = meet_round({o.x, o.y, 0}, {d.x, d.y, 0}, r_);
    if (!roots) return std::nullopt;
    return first_hit(*roots, ray.t_max, [&](double t) { return parameters(o + d * t); });
  }

  template <std::derived_from<SurfaceGeometry> Point = SurfaceGeometry>
  constexpr Point surface_point(Vec2 uv) const {
    const auto [s, c] = elementary::sin_cos(sweep_.phi(uv.x));
    Point point;
    point.p = narrow({r_ * c, r_ * s, z_min_ + uv.y * (double{z_max_} - z_min_)});
    point.p_error = gamma_bound(2) * abs(point.p);
    point.ng = point.ns = narrow({c, s, 0});
    point.dpdu = narrow(DoubleVec3{-s, c, 0} * (r_ * sweep_.phi_max()));
    point.dpdv = {0, 0, z_max_ - z_min_};
    point.uv = uv;
    return point;
  }

  constexpr float area() const { return static_cast<float>(sweep_.phi_max() * r_ * (double{z_max_} - z_min_)); }

  constexpr Vec2 sample_area(Vec2 u) const { return u; }
  constexpr std::optional<Vec2> area_numbers(const Vec3& p) const { return parameters(widen(p)); }

 private:
  constexpr std::optional<Vec2> parameters(const DoubleVec3& p) const {
    if (p.z < z_min_ || p.z > z_max_) return std::nullopt;
    const auto u = sweep_.u_of(p.x, p.y);
    if (!u) return std::nullopt;
    return Vec2{*u, static_cast<float>((p.z - z_min_) / (double{z_max_} - z_min_))};
  }

  float r_, z_min_, z_max_;
  Sweep sweep_;
};

}  // namespace dspm
